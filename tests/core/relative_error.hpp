// How far a number in quad is from what it should be.
#pragma once

#include <cmath>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff::testing {

/// Relative to 1 + |expected|; infinite where the value is not finite.
inline double relative_error(Quad value, Quad expected) {
  return isfinite(value) ? static_cast<double>(abs(value - expected) / (Quad(1) + abs(expected))) : INFINITY;
}

}  // namespace pfaff::testing
