// Extrapolation of what changes smoothly from step to step, by backward differences.
//
// The next value is expected to be the sum of the last value and its backward differences. A prediction with
// the differences below order d misses by the difference of order d, so that another difference is used only
// as long as it was smaller in the last step than the one before it. Rough or noisy sequences therefore use
// few.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include <pfaff/core/linear/vector.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The number of differences worth keeping. In steps that resolve the motion, that many reach round-off.
template <class T>
inline constexpr int difference_levels = std::numeric_limits<Value<T>>::digits / 10;

/// The most differences that a predictor can keep.
inline constexpr int most_difference_levels = 16;

/// Predicts `Size` numbers from up to `Levels` past steps; `Levels` is at most most_difference_levels, and
/// both may be dynamic.
template <class T, int Size, int Levels>
class DifferencePredictor {
 public:
  /// `levels` beyond most_difference_levels are not kept.
  DifferencePredictor(std::size_t size, std::size_t levels)
      : levels_(std::min(levels, static_cast<std::size_t>(most_difference_levels))),
        differences_(size * levels_) {}

  /// The k-th number expected; zero as long as nothing is known.
  [[nodiscard]] T expected(std::size_t k) const {
    T sum(0);
    for (std::size_t d = 0; d < useful_; ++d) sum = sum + differences_[k * levels() + d];
    return sum;
  }

  /// The k-th number of the last step; zero as long as nothing is known.
  [[nodiscard]] T latest(std::size_t k) const { return useful_ > 0 ? differences_[k * levels()] : T(0); }

  /// Is anything known?
  [[nodiscard]] bool knows() const { return useful_ > 0; }

  /// Forgets all past steps.
  void forget() { useful_ = 0; }

  /// Takes the numbers of the step just made, actual(k) for every k.
  template <class Actual>
  void remember(const Actual& actual) {
    std::array<Value<T>, static_cast<std::size_t>(most_difference_levels)> size{};
    for (std::size_t k = 0; k * levels() < differences_.size(); ++k) {
      T difference = actual(k);
      for (std::size_t d = 0; d < levels(); ++d) {
        T& kept = differences_[k * levels() + d];
        const T previous = kept;
        kept = difference;
        size[d] += abs(value_of(difference));
        difference = difference - previous;
      }
    }
    useful_ = 1;
    while (useful_ < levels() && size[useful_] < size[useful_ - 1]) ++useful_;
  }

 private:
  static constexpr int total = Size == dynamic || Levels == dynamic ? dynamic : Size * Levels;

  [[nodiscard]] std::size_t levels() const {
    return Levels == dynamic ? levels_ : static_cast<std::size_t>(Levels);
  }

  std::size_t levels_, useful_ = 0;
  Vector<T, total> differences_;  // [number][level]
};

}  // namespace pfaff
