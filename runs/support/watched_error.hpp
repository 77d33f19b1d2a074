// The errors of one quantity over a run.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include <pfaff/runs/support/drift.hpp>

namespace pfaff {

/// The errors of one quantity over a run. A DriftAccumulator takes no more of them once one is beyond 1e150;
/// the largest and the last one are known nevertheless, and then the sum of the squares is said to be
/// infinite.
class WatchedError {
 public:
  /// Takes the next error; false where it is not finite.
  [[nodiscard]] bool add(double t, double error) {
    if (!std::isfinite(error)) return false;
    drift_.add(t, error);
    largest_ = std::max(largest_, std::abs(error));
    last_ = error;
    return true;
  }
  /// Takes errors of at most 1e150, after the steps first, first + stride, … of size h from t0.
  void add(double t0, double h, std::int64_t first, std::int64_t stride, std::span<const double> errors) {
    drift_.add(t0, h, first, stride, errors);
    last_ = errors.back();
  }
  [[nodiscard]] Drift result(const RoundOff& round_off) const {
    Drift drift = drift_.result(round_off);
    if (drift.non_finite == 0) return drift;
    drift.maximum = std::max(drift.maximum, largest_);
    drift.final_value = last_;
    drift.rms = std::numeric_limits<double>::infinity();
    return drift;
  }

 private:
  DriftAccumulator drift_;
  double largest_ = 0;  // of those that came one by one, as all do that are beyond 1e150
  double last_ = 0;
};

}  // namespace pfaff
