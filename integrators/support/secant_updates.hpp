// Secants: what the corrections of a simplified Newton iteration tell about the matrix that they were made
// with.
//
// Two corrections and the residuals between them say what the true Jacobian does in one direction. Broyden's
// method changes the matrix B_0 of the iteration so that it does the same (kelley1995, 7.3). With
// z = B_0^-1 r and the corrections s_0, ..., s_k so far the next one is
//
//     z := z + s_{j+1} (s_j^T z) / (s_j^T s_j),   j = 0, ..., k - 1,
//     s_{k+1} = z / (1 - s_k^T z / s_k^T s_k).
//
// Corrections then become smaller faster than by a fixed ratio. Components are weighed by their size, so that
// the units of a chart do not matter. Derivatives are corrected by the same matrices as values.
//
// The direction of a correction at round-off, and what the residual does along it, are rounding errors. Such
// corrections are made with the matrices so far and teach nothing; the derivatives, which converge later than
// the values, would be corrected by matrices of noise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <pfaff/core/linear/vector.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// For N numbers of type T, or a size set at construction.
template <class T, int N = dynamic>
class SecantUpdates {
 public:
  using Number = Value<T>;
  /// Corrections beyond this many are not kept; an iteration that long gains nothing from them.
  static constexpr std::size_t most = 12;
  /// Corrections below so many units of round-off teach nothing.
  static constexpr int least = 64;

  explicit SecantUpdates(std::size_t size) : weight_(size), steps_(most * size) {}

  /// At the beginning of an iteration with another matrix.
  void forget() { count_ = 0; }
  /// correction := what the matrices so far make of a correction by the first one. Components are measured by
  /// the larger of two references.
  void improve(Vector<T, N>& correction, const Vector<T, N>& reference, const Vector<T, N>& change) {
    if (count_ == 0) return keep(correction, Number(1));
    if (count_ == 1) weigh(reference, change);
    for (std::size_t j = 0; j + 1 < count_; ++j) add(correction, along(j, correction), j + 1);
    if (count_ == most || at_round_off(correction)) return;
    const T last = along(count_ - 1, correction);
    const Number rest = Number(1) - value_of(last);
    if (!(abs(rest) > Number(1e-3))) {  // residuals that hardly differ say nothing
      forget();
      return keep(correction, Number(1));
    }
    keep(correction, Number(1) / rest);
    squares_[count_ - 1] = square(count_ - 1);
    add(correction, last, count_ - 1);
  }

 private:
  static constexpr int kept = N == dynamic ? dynamic : static_cast<int>(most) * N;  // numbers of all steps

  [[nodiscard]] std::size_t size() const { return weight_.size(); }
  [[nodiscard]] bool at_round_off(const Vector<T, N>& correction) const {
    Number largest(0);
    for (std::size_t k = 0; k < size(); ++k)
      largest = std::max(largest, Number(weight_[k] * abs(value_of(correction[k]))));
    return largest <= Number(least) * unit_roundoff<T>();
  }
  // s_j^T x / s_j^T s_j
  [[nodiscard]] T along(std::size_t j, const Vector<T, N>& x) const {
    T sum(0);
    for (std::size_t k = 0; k < size(); ++k)
      sum =
          sum + T(weight_[k] * steps_[j * size() + k]) * (T(weight_[k]) * x[k]);  // weights squared overflow
    return sum * T(squares_[j]);
  }
  // x += factor s_j
  void add(Vector<T, N>& x, const T& factor, std::size_t j) const {
    for (std::size_t k = 0; k < size(); ++k) x[k] = x[k] + factor * T(steps_[j * size() + k]);
  }
  void keep(const Vector<T, N>& x, const Number& factor) {
    for (std::size_t k = 0; k < size(); ++k) steps_[count_ * size() + k] = factor * value_of(x[k]);
    ++count_;
  }
  // 1 / s_j^T s_j
  [[nodiscard]] Number square(std::size_t j) const {
    Number sum(0);
    for (std::size_t k = 0; k < size(); ++k) {
      const Number step = weight_[k] * steps_[j * size() + k];
      sum = sum + step * step;
    }
    return sum > Number(0) ? Number(1) / sum : Number(0);
  }
  void weigh(const Vector<T, N>& reference, const Vector<T, N>& change) {
    for (std::size_t k = 0; k < size(); ++k) {
      const Number scale = std::max(abs(value_of(reference[k])), abs(value_of(change[k])));
      weight_[k] = scale > Number(std::numeric_limits<double>::min()) ? Number(1) / scale : Number(1);
    }
    squares_[0] = square(0);
  }

  std::size_t count_ = 0;
  Vector<Number, N> weight_;
  Vector<Number, kept> steps_;
  std::array<Number, most> squares_{};
};

}  // namespace pfaff
