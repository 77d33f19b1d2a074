// Sums that keep what they round off: for increments that are sums themselves, such as those of the stages of
// a step, where adding them with compensation (summation.hpp) would be too late.
#pragma once

namespace pfaff {

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
