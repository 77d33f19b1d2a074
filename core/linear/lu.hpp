// LU factorisation with row pivoting of small dense matrices over any scalar, without allocation after
// set-up.
//
// Pivots are chosen by the magnitude of the numbers under the scalar, rows scaled by their largest entry, so
// that a system whose rows carry different units (a Darboux chart spanning many decades) is factored as well
// as a balanced one. Right-hand sides may be of a richer scalar than the matrix (a dual right-hand side
// against a plain matrix, as a simplified Newton iteration needs).
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// Factors P A = L U of an n x n matrix.
template <class T>
class LU {
 public:
  explicit LU(std::size_t n) : n_(n), factors_(n * n), reciprocal_(n), order_(n), scale_(n) {}

  /// The n x n row-major matrix to fill before factor().
  T& operator()(std::size_t row, std::size_t column) { return factors_[row * n_ + column]; }
  [[nodiscard]] std::size_t size() const { return n_; }

  /// Factors in place. False when a pivot is zero or not finite: the matrix is singular to working precision.
  bool factor() { return n_ == 2 ? eliminate<2>() : n_ == 4 ? eliminate<4>() : eliminate<0>(); }

  /// solution = A^-1 right_hand_side; the two must not overlap. B is T or a dual over T.
  template <class B>
  void solve(const B* right_hand_side, B* solution) const {
    if (n_ == 2) return substitute<2>(right_hand_side, solution);
    if (n_ == 4) return substitute<4>(right_hand_side, solution);
    substitute<0>(right_hand_side, solution);
  }

 private:
  // N is the size where the compiler gains by unrolling (2 and 4), and 0 for any other. There is one
  // division for each row's scale and one for each pivot; everything else multiplies by their reciprocals.
  template <std::size_t N>
  bool eliminate() {
    const std::size_t n = N == 0 ? n_ : N;
    for (std::size_t i = 0; i < n; ++i) {
      order_[i] = i;
      Value<T> largest(0);
      for (std::size_t j = 0; j < n; ++j) {
        const Value<T> size = abs(value_of(factors_[i * n + j]));
        if (size > largest) largest = size;
      }
      if (!(largest > Value<T>(0)) || !isfinite(largest)) return false;
      scale_[i] = Value<T>(1) / largest;
    }
    for (std::size_t k = 0; k < n; ++k) {
      std::size_t pivot = k;
      Value<T> best(-1);
      for (std::size_t i = k; i < n; ++i) {
        const Value<T> size = abs(value_of(factors_[i * n + k])) * scale_[i];
        if (size > best) {
          best = size;
          pivot = i;
        }
      }
      if (!(best > Value<T>(0)) || !isfinite(best)) return false;
      if (pivot != k) {
        for (std::size_t j = 0; j < n; ++j) std::swap(factors_[k * n + j], factors_[pivot * n + j]);
        std::swap(order_[k], order_[pivot]);
        std::swap(scale_[k], scale_[pivot]);
      }
      reciprocal_[k] = T(1) / factors_[k * n + k];
      for (std::size_t i = k + 1; i < n; ++i) {
        const T factor = factors_[i * n + k] * reciprocal_[k];
        factors_[i * n + k] = factor;
        for (std::size_t j = k + 1; j < n; ++j)
          factors_[i * n + j] = factors_[i * n + j] - factor * factors_[k * n + j];
      }
    }
    return true;
  }
  template <std::size_t N, class B>
  void substitute(const B* right_hand_side, B* solution) const {
    const std::size_t n = N == 0 ? n_ : N;
    for (std::size_t i = 0; i < n; ++i) {
      B sum = right_hand_side[order_[i]];
      for (std::size_t j = 0; j < i; ++j) sum = sum - factors_[i * n + j] * solution[j];
      solution[i] = sum;
    }
    for (std::size_t i = n; i-- > 0;) {
      B sum = solution[i];
      for (std::size_t j = i + 1; j < n; ++j) sum = sum - factors_[i * n + j] * solution[j];
      solution[i] = reciprocal_[i] * sum;
    }
  }

  std::size_t n_;
  std::vector<T> factors_, reciprocal_;
  std::vector<std::size_t> order_;
  std::vector<Value<T>> scale_;
};

}  // namespace pfaff
