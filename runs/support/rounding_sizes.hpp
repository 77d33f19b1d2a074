// What roundings do to the outputs of a tape along a run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/runs/support/drift.hpp>
#include <pfaff/runs/support/output_gradients.hpp>
#include <pfaff/runs/support/term_magnitudes.hpp>

namespace pfaff {

/// The magnitudes of the terms of a tape's outputs along a run, and what steps propagate of the roundings of
/// the state, where that is not too dear to find. Both take longer than a short step, and what they give is
/// read when a run has ended, if at all. So states are kept until somebody asks, or there are many of them,
/// and are then looked at eight together.
class RoundingSizes {
 public:
  explicit RoundingSizes(std::shared_ptr<const Tape> tape) : tape_(std::move(tape)) {}

  void add(double t, const std::vector<double>& z);
  /// The magnitudes at the first state. There is one.
  [[nodiscard]] const std::vector<double>& first_terms();
  /// Of the outputs first, first + stride, ...: the largest of each.
  [[nodiscard]] RoundOff largest(double unit, std::int64_t steps, std::size_t first, std::size_t stride);

 private:
  void take_kept();
  void take(std::size_t first, std::size_t count);

  static constexpr std::size_t most_kept = 1 << 16;  // numbers: half a megabyte

  std::shared_ptr<const Tape> tape_;
  std::vector<double> kept_;  // time and state, one behind the other
  std::size_t size_ = 0;      // of each
  std::optional<TermMagnitudes> terms_;
  std::optional<PropagatedRoundings> propagated_;
  std::vector<double> first_terms_;
  Pack<8> times_ = 0;
  std::vector<Pack<8>> states_;
};

}  // namespace pfaff
