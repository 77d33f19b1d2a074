// The Gauss methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/order_conditions/rooted_trees.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>

namespace {
using namespace pfaff;

const std::vector<Claim> kept_by_gauss{Claim::symmetric, Claim::reversible, Claim::symplectic,
                                       Claim::quadratic_invariants};

struct RegisteredGauss : pfaff::Gauss {
  /// With compensation rounding errors of conserved quantities do a random walk in steps of second order,
  /// where the energy is T(p) + V(q) with a quadratic T, which with six stages and more can be told from
  /// truncation. In steps of first order, of other energies, a small bias is left on some systems.
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const {
    std::vector<Claim> claims = kept_by_gauss;
    if (compensated && stages >= 6 && model.facets().has(Facet::separable) &&
        linear(*model.tape(Formula::velocity)))
      claims.push_back(Claim::unbiased_round_off);
    return claims;
  }
};
struct RegisteredImplicitMidpoint : pfaff::ImplicitMidpoint {
  using Composed = Composition<pfaff::ImplicitMidpoint>;
};

const Method<RegisteredGauss> gauss{
    {.name = "gauss",
     .title = "Gauss collocation, order 2 s",
     .family = "gauss",
     .reference = "hairer-lubich-wanner2006 (II.1.3)",
     .description =
         "Gauss collocation of any number of stages s, implicit and of order 2 s. Take it for smooth "
         "problems at high accuracy and for long runs of any vector field: it is symmetric, symplectic for "
         "constant structures, and keeps quadratic invariants. Structures that depend on the state or on "
         "time are not kept in the system's own variables, and each step solves equations.",
     .preserves = kept_by_gauss}};
const Method<RegisteredImplicitMidpoint> midpoint{
    {.name = "implicit-midpoint",
     .title = "implicit midpoint rule (Euler centre scheme)",
     .family = "gauss",
     .reference = "su-qin (107); hairer-lubich-wanner2006 (II.1.4)",
     .description = "The implicit midpoint rule, Gauss collocation of one stage and the Euler centre scheme "
                    "of Feng's school. Take it as the simplest symplectic method for energies that are not "
                    "separable, where quadratic invariants have to stay, and as the base of compositions "
                    "for any vector field. Its order is 2, and for "
                    "structures that depend on the state or on time it is no longer symplectic.",
     .order = 2,
     .preserves = kept_by_gauss}};

// Trees are listed up to order 10.
OrderTheory gauss_theory(int stages) {
  const GaussCoefficients g = gauss_coefficients(stages);
  return tree_theory({g.matrix, g.weights}, std::min(2 * stages, largest_tree), false);
}
const KnownOrderTheory gauss_conditions{"gauss", [](const Assignments& parameters) {
                                          RegisteredGauss method;
                                          assign_all(RegisteredGauss::parameters(), &method, parameters,
                                                     "integrator gauss");
                                          return gauss_theory(method.stages);
                                        }};
const KnownOrderTheory midpoint_conditions{"implicit-midpoint",
                                           [](const Assignments& /*parameters*/) { return gauss_theory(1); }};
}  // namespace
