// The table that pairs every claim with its measure and its control.
#include <pfaff/verify/claim_checks.hpp>

namespace pfaff {

namespace {

// True for systems with a structure of their own, canonical systems with a chart or an alpha included: what
// methods that do not claim to preserve it do to it is shown on them.
bool own_structure(const Model& model) { return model.facets().has(Facet::structure); }
// True for systems with constraints, on which methods of every kind are compared.
bool constrained(const Model& model) { return model.constrained(); }
bool restricted_with_momentum(const Model& model) {
  return model.restricted() && in_scope(Claim::momentum_maps, model);
}

bool nowhere(const Model& /*model*/) { return false; }

constexpr FalseClaim rk4_on(std::string_view system) { return {.method = "rk4", .system = system}; }

constexpr std::array checks{
    ClaimCheck{.claim = Claim::symplectic,
               .measure = {own_structure_residual<double>, own_structure_residual<Quad>},
               .control = rk4_on("pendulum"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::k_symplectic,
               .measure = {own_structure_residual<double>, own_structure_residual<Quad>},
               .control = rk4_on("damped-pendulum"),
               .from_jacobian = true,
               .shown_on = &own_structure},
    ClaimCheck{.claim = Claim::poisson,
               .measure = {own_structure_residual<double>, own_structure_residual<Quad>},
               .control = rk4_on("free-rigid-body"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::constrained_symplectic,
               .measure = {own_structure_residual<double>, own_structure_residual<Quad>},
               .control = rk4_on("spherical-pendulum"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::conformal,
               .measure = {conformal_residual<double>, conformal_residual<Quad>},
               .control = rk4_on("damped-pendulum"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::volume,
               .measure = {volume_residual<double>, volume_residual<Quad>},
               .control = rk4_on("free-rigid-body"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::symmetric,
               .measure = {symmetry_residual<double>, symmetry_residual<Quad>},
               .control = rk4_on("pendulum")},
    ClaimCheck{.claim = Claim::reversible,
               .measure = {reversibility_residual<double>, reversibility_residual<Quad>},
               .control = rk4_on("pendulum")},
    ClaimCheck{.claim = Claim::quadratic_invariants,
               .measure = {quadratic_invariants_residual<double>, quadratic_invariants_residual<Quad>},
               .control = rk4_on("kepler")},
    ClaimCheck{.claim = Claim::momentum_maps,
               .measure = {momentum_maps_residual<double>, momentum_maps_residual<Quad>},
               .control = rk4_on("spherical-pendulum"),
               .shown_on = &restricted_with_momentum},
    ClaimCheck{.claim = Claim::energy,
               .measure = {energy_residual<double>, energy_residual<Quad>},
               .control = rk4_on("pendulum")},
    ClaimCheck{.claim = Claim::casimirs,
               .measure = {casimirs_residual<double>, casimirs_residual<Quad>},
               .control = rk4_on("free-rigid-body")},
    // The relaxation is chosen so weak that the entropy which RK4 loses as it turns the body is more than the
    // relaxation produces.
    ClaimCheck{
        .claim = Claim::entropy,
        .measure = {entropy_residual<double>, entropy_residual<Quad>},
        .control = {.method = "rk4", .system = "relaxing-rigid-body", .key = "alpha", .value = "1e-12"}},
    ClaimCheck{.claim = Claim::constraints,
               .measure = {constraints_residual<double>, constraints_residual<Quad>},
               .control = rk4_on("spherical-pendulum"),
               .shown_on = &constrained},
    ClaimCheck{.claim = Claim::velocity_constraints,
               .measure = {velocity_constraints_residual<double>, velocity_constraints_residual<Quad>},
               .control = {.method = "rk4", .system = "sliding blade", .model = &sliding_blade}},
    ClaimCheck{.claim = Claim::nonholonomic_momentum,
               .measure = {nonholonomic_momentum_residual<double>, nonholonomic_momentum_residual<Quad>},
               .control = {.method = "rk4", .system = "bead in a bowl", .model = &bead_in_a_bowl}},
    // The plain update, which rounds the whole state in every step.
    ClaimCheck{.claim = Claim::unbiased_round_off,
               .measure = {round_off_residual, nullptr},
               .control = {.method = "gauss",
                           .system = "harmonic-oscillator",
                           .method_key = "compensated",
                           .method_value = "no"},
               .of_rounding = true,
               .shown_on = &nowhere}};

constexpr bool complete() {
  std::size_t k = 0;
  for (const ClaimRow& row : claim_table) {
    if (k == checks.size() || checks[k].claim != row.claim || checks[k].control.method.empty() ||
        checks[k].control.system.empty())
      return false;
    ++k;
  }
  return k == checks.size();
}
static_assert(complete(),
              "every claim of core/facets/claim_rows.hpp needs a row here, in the same order, with its "
              "measures and a false claim of it as a control");

}  // namespace

std::span<const ClaimCheck> claim_checks() { return checks; }

}  // namespace pfaff
