// The scalars that registered methods are instantiated for.
#pragma once

#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// Directions differentiated in one pass of a step.
inline constexpr int step_directions = 4;

/// A number with the derivatives of a step in it.
template <class T>
using StepDual = Dual<T, step_directions>;

}  // namespace pfaff
