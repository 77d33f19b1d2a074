// drift: how an invariant's error behaves over a run, from one pass over its samples in bounded memory.
//
// Input: e_k = I(t_k) - I(t_0), or the relative error if the caller prefers (slopes and amplitudes then have
// its units), at times t_k that increase or decrease and are equally spaced or nearly so. Samples are
// averaged in at most `capacity` blocks of equal length; when full, neighbours merge and the length doubles.
// The first 128 blocks of each length are kept, so that what happens at the start of a run of any length is
// seen in 64 blocks at least, or sample by sample.
//
// Numbers that need no model, from all samples:
//     maximum = max |e_k|,   rms = sqrt(mean e_k^2),   final_value = the last e_k.
// Trend: slope with a 95 % interval that allows for correlated errors, from means over windows of the run,
// see window_scores.hpp. Oscillation: half peak-to-peak and rms about that trend. Class: by the rules of
// drift_rules.hpp, with one line of evidence. How often they are right is measured by
// tests/drift/error_rates.cpp and stands in docs/drift-and-cost.md.
//
// Limits: |e| must be 0 or in [1e-150, 1e150]: squares of smaller ones vanish, larger ones count as not
// finite. Unequal sampling is allowed for in times and weights but not in the noise models. Without its scale
// an error is never called round-off. Results are deterministic functions of the samples and their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pfaff/runs/support/drift_class.hpp>
#include <pfaff/runs/support/envelope.hpp>
#include <pfaff/runs/support/error_sums.hpp>
#include <pfaff/runs/support/windows.hpp>

namespace pfaff {

/// What round-off, and what loss, mean for a series.
struct RoundOff {
  double unit = 0;   // of the number format: 2^-53 in double, 2^-113 in quad
  double scale = 0;  // the largest sum of the magnitudes of the quantity's terms, [e]; 0 where it is unknown
  std::int64_t steps = 0;  // of the run
  /// The largest sum_i |dI/dz_i z_i| of the quantity I in the state z, [e]: what the roundings of a step
  /// change, in units of round-off (output_gradients.hpp). Where it is unknown, `scale` stands for it.
  std::optional<double> propagated = std::nullopt;
  /// How much of the quantity can be lost, [e]: its distance from the equilibrium, or |I(0)|. Where it is
  /// unknown, or 0 because every term is 0 at the start, `scale` stands for it.
  std::optional<double> range = std::nullopt;

  [[nodiscard]] double walk() const { return propagated.value_or(scale); }
  [[nodiscard]] double own_range() const { return range.value_or(0) > 0 ? *range : scale; }
};

/// Units: [e] of the errors, [t] of the times.
struct Drift {
  DriftClass drift_class = DriftClass::undetermined;
  /// Why it is that class: one line without a full stop, for readers. It has no comma, so that it may stand
  /// in a table of values that are separated by commas.
  std::string evidence;

  std::size_t samples = 0;     // used: up to the first that is not finite
  std::size_t non_finite = 0;  // samples with a time or an error that is not finite, or |e| > 1e150
  /// Time given with the first of them; nothing after it was used.
  std::optional<double> non_finite_time;

  double maximum = 0;      // max |e|, [e]
  double rms = 0;          // [e]
  double final_value = 0;  // last e, [e]

  /// Linear trend and its 95 % interval, [e/t]. Below 32 samples the slope is that of least squares and the
  /// interval infinite (null in JSON); below 2 the slope is 0. A slope by which the errors would leave their
  /// range is none: then that of least squares stands here, and the interval has it and 0 in it. For
  /// polynomial and exponential growth the slope is a mean rate and the interval wide, because a line does
  /// not fit. Where the quantity is lost and the class is that of a part of the run, so are slope, exponent
  /// and rate.
  double slope = 0, slope_low = 0, slope_high = 0;

  double oscillation_amplitude = 0;  // half peak-to-peak about the trend, [e]
  double oscillation_rms = 0;        // rms about the least-squares line, [e]; amplitude / sqrt(2) for a sine

  /// Exponent of |e| ~ t^exponent and its interval: 0 for bounded errors, without an interval; absent for
  /// other classes that do not grow as a power.
  std::optional<windows::Estimate> exponent;
  /// lambda of |e| ~ exp(lambda t), [1/t], and its interval; only for exponential. Negative if time runs
  /// backwards.
  std::optional<windows::Estimate> rate;
};

/// Collects one error series. Cheap to copy; result() may be asked for at any time.
class DriftAccumulator {
 public:
  /// `capacity`: most blocks kept, made even and at least 64.
  explicit DriftAccumulator(std::size_t capacity = 2048);

  /// Takes the next sample, also one that is not finite. Allocates where blocks merge, which is each time
  /// that the number of samples has doubled, and in a copy.
  void add(double t, double error);
  /// The samples at t0 + (first + k stride) h, of which none but the caller's last ones are looked at yet:
  /// they are taken so many at a time that no digit of a result depends on how they come. A number that is
  /// not finite counts as above.
  void add(double t0, double h, std::int64_t first, std::int64_t stride, std::span<const double> errors);

  [[nodiscard]] Drift result(const RoundOff& round_off = {}) const;

  /// Of what was taken so far one by one, or in whole groups: in order of time; all but the last of equal
  /// count.
  [[nodiscard]] const std::vector<windows::Block>& blocks() const { return blocks_; }

  /// The largest size of an error that is taken.
  static constexpr double largest_error = 1e150;

  /// Most different values of which count is kept.
  static constexpr std::size_t most_values = 40;

  /// Most blocks of each length that are kept of the start of a run.
  static constexpr std::size_t most_at_start = 128;

 private:
  /// Sums about the means of all samples [welford1962].
  struct Moments {
    double mean_time = 0, mean = 0, time_time = 0, time_error = 0, error_error = 0;
  };
  /// The times of samples that wait to be taken.
  struct Steps {
    double t0 = 0, h = 0;
    std::int64_t first = 0, stride = 1;
    friend bool operator==(const Steps&, const Steps&) = default;
  };
  /// Of the samples that are taken together, and of those that wait for that: a quarter of a megabyte.
  static constexpr std::size_t group = 256, most_waiting = 32768;
  static constexpr std::size_t first_room = 4096;  // for them, in a run that may be short

  void take_one(double t, double error);
  void take_waiting();
  void take(double t, double dt, std::span<const double> errors);
  void add_moments(double t, double dt, double last, const sums::Sums& of);
  void append(const windows::Block& some);
  void note_values(std::span<const double> errors);
  [[nodiscard]] std::size_t room_in_block() const;
  void double_length();
  [[nodiscard]] Drift result_of_taken(const RoundOff& round_off) const;

  std::size_t capacity_, block_length_ = 1;
  std::size_t known_length_ = 1;  // that the samples which are taken or wait will need
  std::vector<windows::Block> blocks_;
  std::vector<std::vector<windows::Block>> starts_;  // of shorter blocks, the shortest first
  std::vector<double> values_;                       // different values, one more than most_values at most
  std::size_t samples_ = 0, non_finite_ = 0, rises_ = 0, falls_ = 0;
  double first_time_ = 0, last_time_ = 0, last_error_ = 0, non_finite_time_ = 0;
  Moments moments_;
  std::vector<double> waiting_;
  Steps steps_of_waiting_;
};

}  // namespace pfaff
