// Scales of coordinates, by which what is measured does not depend on the units in which a system is written.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The part of the largest coordinate at which another is what cancelling numbers in quad have left of zero.
inline constexpr double no_size = 1e-40;

/// The powers of two nearest to sizes of coordinates, by which the numbers of a system in other units are the
/// same to the last bit where these are powers of two. A size that is not finite is taken as one; one that is
/// zero, or `no_size` of the largest, is not known and taken for the largest one.
std::vector<double> scales_of(const std::vector<double>& sizes);

/// A state in coordinates divided by their scales: the root of the sum of the squares.
template <class T, class State>
T scaled_norm(const State& z, const std::vector<double>& scales) {
  T square(0);
  for (std::size_t k = 0; k < scales.size(); ++k) {
    const T x = z[k] / T(scales[k]);
    square += x * x;
  }
  return sqrt(square);
}

}  // namespace pfaff
