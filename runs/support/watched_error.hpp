// The errors of one quantity over a run, and what roundings do to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/runs/support/drift.hpp>
#include <pfaff/runs/support/output_gradients.hpp>
#include <pfaff/runs/support/term_magnitudes.hpp>

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
  /// Takes the finite errors after the steps first, first + stride, … of size h from t0.
  void add(double t0, double h, std::int64_t first, std::int64_t stride, std::span<const double> errors) {
    drift_.add(t0, h, first, stride, errors);
    for (const double error : errors) largest_ = std::max(largest_, std::abs(error));
    last_ = errors.back();
  }
  [[nodiscard]] Drift result(const RoundOff& round_off) const {
    Drift drift = drift_.result(round_off);
    if (drift.non_finite == 0) return drift;
    drift.maximum = largest_;
    drift.final_value = last_;
    drift.rms = std::numeric_limits<double>::infinity();
    return drift;
  }

 private:
  DriftAccumulator drift_;
  double largest_ = 0, last_ = 0;
};

/// What roundings do to the outputs of a tape along a run: the magnitudes of their terms, and what steps
/// propagate of the roundings of the state, where that is not too dear to find. States wait until there are
/// eight, which are looked at together.
class RoundingSizes {
 public:
  explicit RoundingSizes(std::shared_ptr<const Tape> tape) : terms_(tape) {
    if (takes_gradients(*tape)) propagated_.emplace(*tape);
  }
  void add(double t, const std::vector<double>& z) {
    waiting_.resize(z.size());
    times_.set(count_, t);
    for (std::size_t i = 0; i < z.size(); ++i) waiting_[i].set(count_, z[i]);
    if (++count_ == 8) take_waiting();
  }
  [[nodiscard]] const std::vector<double>& terms() {
    take_waiting();
    return terms_.largest();
  }
  /// Of the outputs first, first + stride, ...: the largest of each.
  [[nodiscard]] RoundOff largest(double unit, std::int64_t steps, std::size_t first, std::size_t stride) {
    take_waiting();
    RoundOff result{unit, 0, steps};
    if (propagated_) result.propagated = 0;
    for (std::size_t k = first; k < terms_.largest().size(); k += stride) {
      result.scale = std::max(result.scale, terms_.largest()[k]);
      if (propagated_) result.propagated = std::max(*result.propagated, propagated_->largest()[k]);
    }
    return result;
  }

 private:
  // In lanes behind the last state that waits stand copies of it.
  void take_waiting() {
    if (count_ == 0) return;
    for (std::size_t lane = count_; lane < 8; ++lane) {
      times_.set(lane, times_[count_ - 1]);
      for (Pack<8>& x : waiting_) x.set(lane, x[count_ - 1]);
    }
    terms_.add(times_, waiting_.data());
    if (propagated_) propagated_->add(times_, waiting_.data());
    count_ = 0;
  }

  TermMagnitudes terms_;
  std::optional<PropagatedRoundings> propagated_;
  Pack<8> times_ = 0;
  std::vector<Pack<8>> waiting_;
  std::size_t count_ = 0;  // of those that wait
};

}  // namespace pfaff
