// The discrete gradient method for velocity constraints as a plug-in.
#include <pfaff/integrators/nonholonomic/discrete_gradient.hpp>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct NonholonomicDiscreteGradient : pfaff::NonholonomicDiscreteGradient {
  using Composed = Composition<pfaff::NonholonomicDiscreteGradient>;
};

const Method<NonholonomicDiscreteGradient> registered{
    {.name = "nonholonomic-discrete-gradient",
     .title = "discrete gradient method for velocity constraints, which keeps the energy",
     .reference = "celledoni-farre-hoiseth-martin2019; gonzalez1996",
     .description =
         "A discrete gradient method for velocity constraints, symmetric and of order 2, that keeps any "
         "energy "
         "H(q, p) and the constraints to round-off. Take it where the energy must not be lost in steps that "
         "are "
         "large, or along chaotic motion. Each step is implicit in all states and costs several times one of "
         "`dla`; where constraints do work (b is not 0), energies are not kept by the motion either.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::energy, Claim::velocity_constraints}}};
}  // namespace
