// drift: how an invariant's error behaves over a run, from one pass over its samples in bounded memory.
//
// Input: e_k = I(t_k) - I(t_0), or the relative error if the caller prefers (slopes and amplitudes then have
// its units), at times t_k that increase or decrease and are equally spaced or nearly so. Samples are
// averaged in at most `capacity` blocks of equal length; when full, neighbours merge and the length doubles.
//
// Numbers that need no model, from all samples:
//     maximum = max |e_k|,   rms = sqrt(mean e_k^2),   final_value = the last e_k.
// Trend: slope with a 95 % interval that allows for correlated errors, see low_frequency.hpp. The slope is
// that of weighted least squares of the block means with weight s (1 - s), s in (0, 1) the scaled time. The
// weight vanishes at both ends, so that oscillations hardly change the slope: with an oscillation of 1000
// periods and 100 times the size of the final trend, plain least squares errs by up to 20 % of the slope, the
// weighted one by 0.1 %. For runs over 40 periods and more (period, phase and length drawn at random) 97 % of
// the intervals contain the true slope.
// Oscillation: rms and half peak-to-peak about the plain least-squares line over all samples.
//
// Class. The candidates (kinds of noise without a trend, and trends in noise) are compared by their posterior
// weights, given the same low-frequency data. A class is assigned where one kind of noise, or all trends
// together, have more than half of the weight (the priors are in drift.cpp):
//   bounded       no trend; noise white, AR(1), or a fast or slow oscillation         growth exponent 0
//   random-walk   no trend; |e| ~ t^alpha, alpha = d - 1/2 of the noise, in [1/4, 1]
//                 (round-off obeying Brouwer's law: 1/2 [hairer2008brouwer])          growth exponent alpha
//   linear        trend t^p, 3/4 <= p <= 5/4, and the slope's interval excludes 0     growth exponent p
//   polynomial    trend t^p, p > 5/4                                                  growth exponent p
//   exponential   trend exp(lambda t); or the block rms grows by more than e^3, and
//                 its log has a quarter of the residual squares about a line in t
//                 that it has about a line in log t                                   growth rate lambda
//   exact         every error is zero, and there are at least two
//   undetermined  none of these; or fewer than 32 samples; or a sample that is not finite
// If the means are bounded but the block rms at least doubles from the first to the last quarter of the run,
// the block rms is classified in the same way: t cos(omega t) is linear, with slope 0. All classes, those
// that are not assigned yet included, are in drift_class.hpp.
//
// Limits, as measured (400 seeds each):
//  - What lasts longer than the run cannot be told from a trend. A sine is called bounded when the run covers
//    1 1/4 of its periods or more, and the interval of its slope contains zero from 1 1/2 periods on; a sum
//    of slow sines needs 2 1/2 periods of the slowest. Shorter runs are mostly undetermined; a quarter of a
//    period is called a line or a power. The same is true of the period of a beat.
//  - AR(1) errors are called a random walk in 1.5 % of runs when the run has 100 correlation times, in 20 %
//    when it has 30, in 65 % when it has 10: over so short a run the two hardly differ.
//  - Random walks are called so in 88 to 92 % of runs, linear in 4 %, bounded in 5 %. The exponent of one run
//    is good to +-0.12, with a bias of +0.05. 95 % intervals of the slope cover zero in 88 to 90 % of runs.
//  - White noise is bounded in 97.5 %, undetermined in 1.5 %, a random walk in 0.8 %.
//  - For AR(1) errors with a correlation time up to 1/10 of the run, 97.5 to 99 % of the 95 % intervals
//    contain the slope: they are too wide rather than too narrow.
//  - An integrated random walk (t^1.5 on average, with a random slope of its own) is mostly polynomial,
//    sometimes anything; its intervals hold in 60 %.
//  - A line in white noise must be 7 standard errors steep to be called linear in 90 % of runs (5: 70 %),
//    because a random walk must be excluded too; a line in a random walk of unit steps, 10 / sqrt(samples).
//  - Growth that levels off (1 - exp(-t/tau), t^p with p < 3/4) has no class: bounded for tau << T, otherwise
//    undetermined or linear. Nor has a single step, which may pass for linear.
//  - A sampling interval near a multiple of the oscillation's period aliases it to a slow one. Blocks do so
//    too, at about 1/(number of periods) of the amplitude; intervals allow for it.
//  - |e| must be 0 or in [1e-150, 1e150]: squares of smaller ones vanish, larger ones count as not finite.
//  - Unequal sampling is allowed for in times and weights but not in the noise models.
// Results are deterministic functions of the samples and their order. Cost: 15 ns a sample, 2 to 4 ms a
// result, 60 ms once for the noise models.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <pfaff/bench/measure/drift_class.hpp>

namespace pfaff {

/// Units: [e] of the errors, [t] of the times.
struct Drift {
  DriftClass drift_class = DriftClass::undetermined;
  /// Posterior weight of the class, of all trends together for a trend; 1 for exact and for an exponential
  /// envelope, 0 for undetermined. Not a frequency of being right: see the limits above.
  double probability = 0;

  std::size_t samples = 0;     // used: up to the first that is not finite
  std::size_t non_finite = 0;  // samples with a time or an error that is not finite, or |e| > 1e150
  /// Time given with the first of them; nothing after it was used and drift_class is undetermined.
  std::optional<double> non_finite_time;

  double maximum = 0;      // max |e|, [e]
  double rms = 0;          // [e]
  double final_value = 0;  // last e, [e]

  /// Linear trend and its 95 % interval, [e/t]. Below 4 samples the interval is infinite (null in JSON),
  /// below 2 the slope is 0. For polynomial and exponential growth the slope is a mean rate and the interval
  /// wide, because a line does not fit.
  double slope = 0, slope_low = 0, slope_high = 0;

  double oscillation_amplitude = 0;  // half peak-to-peak about the least-squares line, [e]
  double oscillation_rms = 0;        // rms about it, [e]; amplitude / sqrt(2) for a sine

  /// alpha or p of |e| ~ t^exponent; absent for exact, exponential and undetermined.
  std::optional<double> growth_exponent;
  /// lambda, [1/t]; only for exponential. Negative if time runs backwards.
  std::optional<double> growth_rate;
};

/// Collects one error series. Cheap to copy; result() may be asked for at any time.
class DriftAccumulator {
 public:
  /// Statistics of consecutive samples.
  struct Block {
    std::size_t count = 0;
    double time = 0, mean = 0;                         // means of t and e
    double minimum = 0, maximum = 0, mean_square = 0;  // of e
  };

  /// `capacity`: most blocks kept, made even and at least 64.
  explicit DriftAccumulator(std::size_t capacity = 2048);

  /// Takes the next sample, also one that is not finite. Allocates nothing, except in a copy.
  void add(double t, double error);

  Drift result() const;

  /// In order of time; all but the last of equal count.
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  /// Sums about the means of all samples [welford1962].
  struct Moments {
    double mean_time = 0, mean = 0, time_time = 0, time_error = 0, error_error = 0;
  };

  std::size_t capacity_, block_length_ = 1;
  std::vector<Block> blocks_;
  std::size_t samples_ = 0, non_finite_ = 0;
  double first_time_ = 0, last_time_ = 0, last_error_ = 0, non_finite_time_ = 0;
  Moments moments_;
};

}  // namespace pfaff
