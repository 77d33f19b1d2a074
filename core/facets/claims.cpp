#include <pfaff/core/facets/claims.hpp>

#include <algorithm>
#include <random>

#include <pfaff/core/facets/complete_tables.hpp>
#include <pfaff/core/facets/linear_reversal.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

template struct CompleteFacets<facet_table>;
template struct CompleteFormulas<formula_table>;
template struct CompleteClaims<claim_table>;

bool momentum_map(const Model& model, std::size_t invariant) {
  const Invariant& i = model.invariants()[invariant];
  if (!i.quadratic || i.behaviour != Behaviour::conserved || !model.canonical()) return false;
  // A quadratic invariant has no part without p where I(q, 0) = 0, and none quadratic in p where
  // I(0, 2 p) = 2 I(0, p). Both are tried at random q and p.
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

bool allowed_momentum_map(const Model& model, std::size_t invariant) {
  if (!model.nonholonomic() || !momentum_map(model, invariant)) return false;
  Replay<Quad> values(model.tape(Formula::invariants)), rows(model.tape(Formula::velocity_constraints));
  const auto n = static_cast<std::size_t>(model.dimension()) / 2;
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<Quad> z(2 * n), out(model.invariants().size()), a(rows.tape().outputs.size());
  for (int point = 0; point < 3; ++point) {
    for (std::size_t k = 0; k < n; ++k) z[k] = Quad(number(random));
    const Quad t(number(random));
    rows(t, z.data(), a.data());
    std::vector<Quad> along(a.size() / n);
    for (std::size_t k = 0; k < n; ++k) {  // component k of D q + d is the invariant with p = e_k
      z[n + k] = Quad(1);
      values(t, z.data(), out.data());
      z[n + k] = Quad(0);
      for (std::size_t i = 0; i < along.size(); ++i) along[i] += a[i * n + k] * out[invariant];
    }
    for (const Quad& x : along)
      if (!(abs(x) <= Quad(1e-30))) return false;  // round-off of a sum of products of ordinary numbers
  }
  return true;
}

namespace {

// The scopes, by the names they have in the list.

bool every_system(const Model& /*model*/) { return true; }

bool has_canonical_structure(const Model& model) {
  return model.facets().has(Facet::darboux_chart) && !model.facets().has(Facet::structure);
}

bool chart_or_alpha(const Model& model) {
  return model.facets().has(Facet::darboux_chart) || model.facets().has(Facet::generating_map);
}

bool poisson_tensor_alone(const Model& model) {
  return model.facets().has(Facet::hamiltonian) && !model.facets().has(Facet::structure) &&
         !model.facets().has(Facet::darboux_chart);
}

bool stated_reversal(const Model& model) { return linear_reversal(model) && model.autonomous(); }

bool stated_casimirs(const Model& model) {
  return model.facets().has(Facet::hamiltonian) && model.given(Formula::casimirs);
}

bool holonomic_constraints(const Model& model) { return model.holonomic(); }

bool velocity_constraints(const Model& model) { return model.facets().has(Facet::velocity_constraints); }

bool linear_friction(const Model& model) { return model.facets().has(Facet::conformal); }

// The trace of the field's Jacobian vanishes: always where the structure is canonical; elsewhere at random
// points near the initial state, within a twentieth of the size of each coordinate, or of the largest one
// where a coordinate is zero.
bool divergence_free(const Model& model) {
  if (!model.moves() || model.restricted()) return false;
  if (has_canonical_structure(model)) return true;
  const auto n = static_cast<std::size_t>(model.dimension());
  if (model.initial().size() != n) return false;  // there is no point to look at
  Replay<Quad> slopes(model.tape(Formula::field_jacobian));
  Quad largest(0);
  for (const Real& x : model.initial()) largest = std::max(largest, abs(x.quad()));
  if (largest == Quad(0)) largest = Quad(1);
  std::mt19937_64 random(20041);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  std::vector<Quad> z(n), jacobian(n * n);
  for (int point = 0; point < 3; ++point) {
    for (std::size_t k = 0; k < n; ++k) {
      const Quad x = model.initial()[k].quad();
      z[k] = x + Quad(offset(random)) * (x == Quad(0) ? largest : abs(x));
    }
    slopes(Quad(1 + offset(random)), z.data(), jacobian.data());
    Quad trace(0), size(0);
    for (std::size_t k = 0; k < n; ++k) {
      trace += jacobian[k * n + k];
      size += abs(jacobian[k * n + k]);
    }
    if (!(abs(trace) <= Quad(1e-30) * size)) return false;  // some thousand units of round-off
  }
  return true;
}

bool conserved(const Invariant& invariant) { return invariant.behaviour == Behaviour::conserved; }

// What a motion with velocity constraints conserves it conserves on their surface, which methods that keep
// quadratic forms may leave within a step.
bool quadratic_invariants(const Model& model) {
  if (model.nonholonomic()) return false;
  return std::any_of(model.invariants().begin(), model.invariants().end(),
                     [](const Invariant& i) { return i.quadratic && conserved(i); });
}

bool momentum_maps(const Model& model) {
  for (std::size_t k = 0; k < model.invariants().size(); ++k)
    if (momentum_map(model, k)) return true;
  return false;
}

bool allowed_momentum_maps(const Model& model) {
  for (std::size_t k = 0; k < model.invariants().size(); ++k)
    if (allowed_momentum_map(model, k)) return true;
  return false;
}

// True where no constraint of velocities does work: b = 0, and holonomic constraints beside do not move.
bool workless_constraints(const Model& model) {
  return model.nonholonomic() && !model.given(Formula::velocity_offsets) &&
         (!model.given(Formula::holonomic) || model.tape(Formula::holonomic)->autonomous());
}

// Along the motion dH/dt = H_t whatever the bracket, so that H is conserved where it does not depend on time.
bool conserved_energy(const Model& model) {
  return (model.facets().has(Facet::hamiltonian) || workless_constraints(model)) &&
         model.tape(Formula::hamiltonian)->autonomous();
}

bool has_canonical_energy(const Model& model) {
  return has_canonical_structure(model) && conserved_energy(model);
}

bool entropy_of_two_brackets(const Model& model) {
  return model.facets().has(Facet::metriplectic) && model.given(Formula::entropy);
}

}  // namespace

bool in_scope(Claim claim, const Model& model) {
  switch (claim) {
#define PFAFF_CLAIM(claim, name, speaks_of, ...) \
  case Claim::claim:                             \
    return speaks_of(model);
#include <pfaff/core/facets/claim_rows.hpp>
    case Claim::none:
      break;
  }
  return false;
}

std::vector<Claim> claims_in_scope(const std::vector<Claim>& claims, const Model& model) {
  std::vector<Claim> meant;
  for (const Claim claim : claims)
    if (in_scope(claim, model)) meant.push_back(claim);
  if (meant.empty()) meant.push_back(Claim::none);
  return meant;
}

}  // namespace pfaff
