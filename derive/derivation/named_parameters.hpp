// Parameters of a system as symbols of its derived equations.
//
// The formulas of a system are recorded with numbers for its parameters. What the equations look like with
// symbols in their place is found from the equations that other values give: where the parameters a, b, ..
// are numbers with prime factors that nothing else has, a constant r a^j b^k .. of the equations shows its
// exponents, and what is left must be the same rational r for other primes. A parameter stays a number where
// it enters a constant in another way, such as a sum or a root, decides on the form of the equations, such as
// a count, or is 0, which takes terms out of them.
#pragma once

#include <functional>
#include <memory>

#include <pfaff/core/system.hpp>
#include <pfaff/derive/derivation/derivation.hpp>

namespace pfaff {

/// Equations of the model of a system.
using Deriver = std::function<Equations(const Model& model)>;

/// The equations that `deriver` makes of the system's model with these settings, with all parameters as
/// symbols for which that is possible. Equations that have symbols already, those of beads on rods, are left
/// as they are.
Equations with_named_parameters(const SystemPlugin& system, const Assignments& settings,
                                const Deriver& deriver);

}  // namespace pfaff
