// Compensated summation: state updates whose rounding errors do not accumulate step by step.
//
// Each addition keeps the part that was rounded off and returns it to the next increment (Kahan), so that n
// updates lose about one unit in the last place instead of n: what is left is the round-off of the
// increments. Only where that has no bias of its own does the error of a long run grow like the square root
// of the time (Brouwer's law). An increment that is itself a sum keeps what its own additions lost as well
// (add_sum).
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

/// sum = a + b as rounded, and what was rounded off, exactly (Knuth's sum of two); componentwise for duals.
/// `sum` may be the number that a is taken from.
template <class T>
inline void two_sum(const T a, const T b, T& sum, T& lost) {
  sum = a + b;
  const T second = sum - a;
  lost = (a - (sum - second)) + (b - second);
}

/// The same as add_to for an increment that is `increment + lost`, a rounded sum and what was rounded off.
/// Needs |lost + carry| <= |increment| <= |sum| or so.
template <class T>
inline void add_sum(T& sum, T& carry, const T& increment, const T& lost, bool compensated) {
  if (compensated) {
    const T rest = lost + carry;
    const T corrected = increment + rest;
    const T total = sum + corrected;
    carry = (corrected - (total - sum)) + (rest - (corrected - increment));
    sum = total;
  } else {
    sum = sum + increment;
  }
}

}  // namespace pfaff
