#include <pfaff/bench/measure/scope.hpp>

#include <algorithm>
#include <random>

#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

bool momentum_map(const Model& model, std::size_t invariant) {
  if (!model.invariants()[invariant].quadratic || !model.canonical()) return false;
  // No part of it is without p, none is quadratic in p: I(q, 0) = 0 and I(0, 2 p) = 2 I(0, p) at random q, p.
  Replay<Quad> values(model.tape(Formula::invariants));
  const auto n = static_cast<std::size_t>(model.dimension());
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Quad> positions(n), momenta(n), twice(n), out(model.invariants().size());
  for (std::size_t k = 0; k < n / 2; ++k) {
    positions[k] = Quad(number(random));
    momenta[n / 2 + k] = Quad(number(random));
    twice[n / 2 + k] = Quad(2) * momenta[n / 2 + k];
  }
  const auto value = [&](const std::vector<Quad>& z) {
    values(Quad(0), z.data(), out.data());
    return out[invariant];
  };
  const Quad round_off(1e-30);  // of a sum of products of numbers below one
  return abs(value(positions)) <= round_off && abs(value(twice) - Quad(2) * value(momenta)) <= round_off;
}

bool in_scope(Claim claim, const Model& model) {
  const FacetSet facets = model.facets();
  switch (claim) {
    case Claim::symmetric:
      return true;
    case Claim::symplectic:
      return facets.has(Facet::darboux_chart) && !facets.has(Facet::structure);
    case Claim::k_symplectic:
      return facets.has(Facet::darboux_chart) || facets.has(Facet::generating_map);
    case Claim::quadratic_invariants:
      return std::any_of(model.invariants().begin(), model.invariants().end(),
                         [](const Invariant& i) { return i.quadratic; });
    case Claim::constrained_symplectic:
    case Claim::constraints:
      return facets.has(Facet::holonomic);
    case Claim::momentum_maps:
      for (std::size_t k = 0; k < model.invariants().size(); ++k)
        if (momentum_map(model, k)) return true;
      return false;
    case Claim::none:
      break;
  }
  return false;
}

std::vector<Claim> claims_in_scope(const MethodInstance& method, const Model& model) {
  std::vector<Claim> claims;
  for (const Claim claim : method.preserves(model))
    if (in_scope(claim, model)) claims.push_back(claim);
  if (claims.empty()) claims.push_back(Claim::none);
  return claims;
}

}  // namespace pfaff
