// The rows of the tridiagonal matrix S of a path that is folded in the middle (folded_path.hpp): one lane of
// a pack belongs to the left half, the other to the mirrored right half.
#pragma once

#include <array>
#include <cstddef>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/pack.hpp>

namespace pfaff {

using FoldedLanes = Pack<2>;

/// D numbers in each lane.
template <int D>
struct FoldedVector {
  std::array<FoldedLanes, D> x{};
  FoldedLanes& operator[](std::size_t k) { return x[k]; }
  const FoldedLanes& operator[](std::size_t k) const { return x[k]; }
  friend FoldedVector operator-(const FoldedVector& a, const FoldedVector& b) {
    FoldedVector r;
    for (std::size_t k = 0; k < D; ++k) r[k] = a[k] - b[k];
    return r;
  }
  friend FoldedVector operator*(const FoldedLanes& s, const FoldedVector& a) {
    FoldedVector r;
    for (std::size_t k = 0; k < D; ++k) r[k] = s * a[k];
    return r;
  }
  /// The product within each lane.
  friend FoldedLanes dot(const FoldedVector& a, const FoldedVector& b) {
    FoldedLanes sum = a[0] * b[0];
    for (std::size_t k = 1; k < D; ++k) sum = sum + a[k] * b[k];
    return sum;
  }
  /// The product of what is in the left lane of a with what is in the right lane of b.
  friend double across(const FoldedVector& a, const FoldedVector& b) {
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k) sum += a[k][0] * b[k][1];
    return sum;
  }
};

/// Row j is that of the rods between points j and j + 1 of the lanes; `lower` and `skew` couple it with row
/// j - 1.
template <int D>
struct FoldedRow {
  FoldedVector<D> direction, turning;
  FoldedLanes lower, inverse, skew, hidden, rate, multiplier, reduced;
  FoldedLanes border;  // of rings: the closing rod's column
};

/// Where the halves meet: both last rods point at the same bead, and couple with each other.
template <int D>
class FoldedMiddle {
 public:
  FoldedMiddle() = default;
  /// `inverse_mass` is that of the bead, as far as rods couple there.
  FoldedMiddle(double inverse_mass, const FoldedRow<D>& last)
      : left_(1 / last.inverse[0]),
        right_(1 / last.inverse[1]),
        coupling_(inverse_mass * across(last.direction, last.direction)),
        scale_(1 / (left_ * right_ - coupling_ * coupling_)) {}
  [[nodiscard]] FoldedLanes solve(const FoldedLanes& y) const {
    return {(y[0] * right_ - coupling_ * y[1]) * scale_, (y[1] * left_ - coupling_ * y[0]) * scale_};
  }
  /// True where all pivots were usable. `products` is the sum of zero times the reciprocal of each: 0 where
  /// all reciprocals are finite, and otherwise not-a-number.
  [[nodiscard]] bool usable(const FoldedLanes& products) const {
    return products[0] == 0 && products[1] == 0 && scale_ * 0 == 0;
  }

 private:
  double left_ = 0, right_ = 0, coupling_ = 0, scale_ = 0;
};

}  // namespace pfaff
