// How fast a residual that starts at round-off grows: fits of a power law and of an exponential to the
// largest value seen so far.
#pragma once

#include <cstdint>
#include <optional>

namespace pfaff {

/// Two least-squares slopes for r(t), the largest value up to time t. `exponent` is the slope of log r over
/// log t, with equal weight for equal stretches of log t; `rate` is the slope of log r over t, with equal
/// weight for equal stretches of t, in 1/[t]. Both describe the series and test nothing: a power law has a
/// rate too, and an exponential an exponent.
struct Growth {
  double exponent = 0, rate = 0;
};

/// The growth of a series, from one pass over it.
class GrowthFit {
 public:
  /// Takes the next value; times increase and count from the start of the run. Values at t <= 0 and those
  /// before the first that is not zero are left out.
  void add(double time, double value);
  /// Nothing where fewer than eight values are left, where they span less than a factor of four in time, or
  /// where one is not finite.
  [[nodiscard]] std::optional<Growth> growth() const;

 private:
  // Weighted sums about the means so far [welford1962].
  struct Line {
    double weights = 0, mean_x = 0, mean_y = 0, products = 0, squares = 0;
    void add(double x, double y, double weight);
    [[nodiscard]] double slope() const { return products / squares; }
  };
  Line in_log_, in_t_;
  double largest_ = 0, before_ = 0, first_ = 0, last_ = 0;  // the largest value, and times
  std::int64_t taken_ = 0;
  bool finite_ = true;
};

}  // namespace pfaff
