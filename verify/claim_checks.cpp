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
               .in_double = own_structure_residual<double>,
               .in_quad = own_structure_residual<Quad>,
               .control = rk4_on("pendulum"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::k_symplectic,
               .in_double = own_structure_residual<double>,
               .in_quad = own_structure_residual<Quad>,
               .control = rk4_on("damped-pendulum"),
               .from_jacobian = true,
               .shown_on = &own_structure},
    ClaimCheck{.claim = Claim::poisson,
               .in_double = own_structure_residual<double>,
               .in_quad = own_structure_residual<Quad>,
               .control = rk4_on("free-rigid-body"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::constrained_symplectic,
               .in_double = own_structure_residual<double>,
               .in_quad = own_structure_residual<Quad>,
               .control = rk4_on("spherical-pendulum"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::conformal,
               .in_double = conformal_residual<double>,
               .in_quad = conformal_residual<Quad>,
               .control = rk4_on("damped-pendulum"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::volume,
               .in_double = volume_residual<double>,
               .in_quad = volume_residual<Quad>,
               .control = rk4_on("free-rigid-body"),
               .from_jacobian = true},
    ClaimCheck{.claim = Claim::symmetric,
               .in_double = symmetry_residual<double>,
               .in_quad = symmetry_residual<Quad>,
               .control = rk4_on("pendulum")},
    ClaimCheck{.claim = Claim::reversible,
               .in_double = reversibility_residual<double>,
               .in_quad = reversibility_residual<Quad>,
               .control = rk4_on("pendulum")},
    ClaimCheck{.claim = Claim::quadratic_invariants,
               .in_double = quadratic_invariants_residual<double>,
               .in_quad = quadratic_invariants_residual<Quad>,
               .control = rk4_on("kepler")},
    ClaimCheck{.claim = Claim::momentum_maps,
               .in_double = momentum_maps_residual<double>,
               .in_quad = momentum_maps_residual<Quad>,
               .control = rk4_on("spherical-pendulum"),
               .shown_on = &restricted_with_momentum},
    ClaimCheck{.claim = Claim::energy,
               .in_double = energy_residual<double>,
               .in_quad = energy_residual<Quad>,
               .control = rk4_on("pendulum")},
    ClaimCheck{.claim = Claim::casimirs,
               .in_double = casimirs_residual<double>,
               .in_quad = casimirs_residual<Quad>,
               .control = rk4_on("free-rigid-body")},
    // The relaxation is chosen so weak that the entropy which RK4 loses as it turns the body is more than the
    // relaxation produces.
    ClaimCheck{
        .claim = Claim::entropy,
        .in_double = entropy_residual<double>,
        .in_quad = entropy_residual<Quad>,
        .control = {.method = "rk4", .system = "relaxing-rigid-body", .key = "alpha", .value = "1e-12"}},
    ClaimCheck{.claim = Claim::constraints,
               .in_double = constraints_residual<double>,
               .in_quad = constraints_residual<Quad>,
               .control = rk4_on("spherical-pendulum"),
               .shown_on = &constrained},
    ClaimCheck{.claim = Claim::velocity_constraints,
               .in_double = velocity_constraints_residual<double>,
               .in_quad = velocity_constraints_residual<Quad>,
               .control = {.method = "rk4", .system = "sliding blade", .model = &sliding_blade}},
    ClaimCheck{.claim = Claim::nonholonomic_momentum,
               .in_double = nonholonomic_momentum_residual<double>,
               .in_quad = nonholonomic_momentum_residual<Quad>,
               .control = {.method = "rk4", .system = "bead in a bowl", .model = &bead_in_a_bowl}},
    // The plain update, which rounds the whole state in every step.
    ClaimCheck{.claim = Claim::unbiased_round_off,
               .in_double = round_off_residual,
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
