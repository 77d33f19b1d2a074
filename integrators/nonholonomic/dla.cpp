// The discrete Lagrange-d'Alembert method as a plug-in.
#include <pfaff/integrators/nonholonomic/dla.hpp>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct DiscreteLagrangeDAlembert : pfaff::DiscreteLagrangeDAlembert {
  using Composed = Composition<pfaff::DiscreteLagrangeDAlembert>;
};

const Method<DiscreteLagrangeDAlembert> registered{
    {.name = "dla",
     .title = "discrete Lagrange-d'Alembert method at the middle of a step",
     .family = "nonholonomic",
     .reference = "cortes-martinez2001",
     .description = "The discrete Lagrange-d'Alembert method for velocity constraints, which hold in the "
                    "middle of a step "
                    "and at its ends, symmetric and of order 2, for any energy H(q, p, t). Take it first for "
                    "nonholonomic "
                    "systems: on reversible ones energies do not drift, and `composition` brings it to every "
                    "even order. "
                    "It keeps no symplectic structure, because nonholonomic motion has none.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::velocity_constraints,
                   Claim::nonholonomic_momentum}}};
}  // namespace
