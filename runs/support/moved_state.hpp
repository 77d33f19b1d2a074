// States beside others, and how far apart they are.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The Euclidean distance of two states.
template <class T>
T euclidean_distance(std::span<const T> a, std::span<const T> b) {
  T square(0);
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(square);
}

/// What a rounding of each coordinate may do to a state: relative changes of this size and of either sign,
/// without a pattern that symmetric states have.
template <class T>
std::vector<T> moved_by(const T& change, std::span<const T> state) {
  std::vector<T> z(state.begin(), state.end());
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] *= std::cos(1 + 2 * static_cast<double>(i)) > 0 ? T(1) + change : T(1) - change;
  return z;
}

}  // namespace pfaff
