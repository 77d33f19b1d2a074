// Compensated summation: state updates whose rounding errors do not accumulate step by step.
//
// Each addition keeps the part that was rounded off and returns it to the next increment (Kahan), so that n
// updates lose about one unit in the last place instead of n: what is left is the round-off of the
// increments, and it grows as the square root of time (Brouwer's law) only where it has no bias.
#pragma once

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// sum += increment, where `carry` holds what earlier additions lost. Needs |increment| <= |sum| or so, the
/// situation of a time step; componentwise for duals.
template <class T>
inline void compensated_add(T& sum, T& carry, const T& increment) {
  const T corrected = increment + carry;
  const T total = sum + corrected;
  carry = corrected - (total - sum);
  sum = total;
}

/// The same with a choice: plain addition when `compensated` is false.
template <class T>
inline void add_to(T& sum, T& carry, const T& increment, bool compensated) {
  if (compensated) {
    compensated_add(sum, carry, increment);
  } else {
    sum = sum + increment;
  }
}

}  // namespace pfaff
