// The checks of formulations.
#pragma once

#include <pfaff/core/formulation.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff {

/// True where a formulation with these parameters is verified on this model. The first parameters of a
/// formulation are verified on every model that is not too large; its other parameters on small models and on
/// those with friction, where a difference can show at little cost.
bool verified_on(const FormulationPlugin& plugin, const Assignments& parameters, const Model& model);

/// Checks a formulation on one model, in double and quad, at random points on the surface of the constraints
/// and off it. The right-hand side is compared with what the formulation's statement defines, and each of its
/// claims is measured; what it does not claim is measured and not judged. Residuals are relative to a bound
/// of the rounding errors of the right-hand side, which its recorded formula gives. Controls: with its
/// reactions reversed the formulation must fail each of its claims. Reactions may do no work, and then
/// reversing them does not change the energy; the control of energy is the field tilted by a millionth of the
/// energy's gradient instead.
std::vector<Check> check_formulation(const FormulationPlugin& plugin, const Assignments& parameters,
                                     const std::shared_ptr<const Model>& model);

}  // namespace pfaff
