// The path of a point whose velocity turns at a constant rate, and the functions it is made of, without a
// division by the rate: straight lines are a case like any other.
//
//   w(t) = (cos d, sin d) with d = rate t,   path = int_0^t w ds,   area = int_0^t (x y' - y x')/2 ds
#pragma once

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// sin(x)/x, 1 at 0.
template <class T>
T cardinal_sine(const T& x) {
  const T square = x * x, divisor = select(square, x, T(1));
  return select(square, sin(divisor) / divisor, T(1));
}

/// (x - sin x)/x^2, 0 at 0. The difference cancels for small x, where its series takes its place.
template <class T>
T cardinal_segment(const T& x) {
  // x/3! (1 - x^2/(4 5) (1 - x^2/(6 7) (...))): for |x| <= 1 the term left out is below 1e-38.
  const T square = x * x;
  T series(1);
  for (int k = 15; k >= 1; --k) series = 1 - square / ((2 * k + 2) * (2 * k + 3)) * series;
  const T large = square - 1, divisor = select(large, x, T(1));
  return select(large, (divisor - sin(divisor)) / (divisor * divisor), x / 6 * series);
}

/// Where a point of unit speed is that starts at the origin along the first axis.
template <class T>
struct CircularPath {
  T along, across, area;
};

template <class T>
CircularPath<T> circular_path(const T& rate, const T& elapsed) {
  const T turn = rate * elapsed, half = turn / 2;
  return {elapsed * cardinal_sine(turn), elapsed * sin(half) * cardinal_sine(half),
          elapsed * elapsed * cardinal_segment(turn) / 2};
}

}  // namespace pfaff
