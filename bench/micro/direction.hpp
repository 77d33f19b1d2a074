// Vectors of the plane or of space whose components are packs: one vector in each lane.
#pragma once

#include <array>
#include <cstddef>

namespace pfaff::micro {

/// A vector of D components, each of the lane type L.
template <class L, int D>
struct Direction {
  std::array<L, D> x{};
  L& operator[](std::size_t d) { return x[d]; }
  const L& operator[](std::size_t d) const { return x[d]; }
  friend Direction operator-(const Direction& a, const Direction& b) {
    Direction r;
    for (std::size_t d = 0; d < D; ++d) r[d] = a[d] - b[d];
    return r;
  }
  friend Direction operator+(const Direction& a, const Direction& b) {
    Direction r;
    for (std::size_t d = 0; d < D; ++d) r[d] = a[d] + b[d];
    return r;
  }
  friend Direction operator*(const L& s, const Direction& a) {
    Direction r;
    for (std::size_t d = 0; d < D; ++d) r[d] = s * a[d];
    return r;
  }
  friend L dot(const Direction& a, const Direction& b) {
    L sum = a[0] * b[0];
    for (std::size_t d = 1; d < D; ++d) sum = sum + a[d] * b[d];
    return sum;
  }
};

}  // namespace pfaff::micro
