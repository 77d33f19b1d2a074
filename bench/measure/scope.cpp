#include <pfaff/bench/measure/scope.hpp>

#include <algorithm>

namespace pfaff {

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
