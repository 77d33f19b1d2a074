// How fast a residual that starts at round-off grows: fits of a power law and of an exponential to the
// largest value seen so far.
#pragma once

#include <optional>
#include <vector>

namespace pfaff {

/// Two least-squares slopes for r(t), the largest value up to time t. `exponent` is the slope of log r over
/// log t, with equal weight for equal stretches of log t; `rate` is the slope of log r over t, with equal
/// weight for equal stretches of t, in 1/[t]. Both describe the series and test nothing: a power law has a
/// rate too, and an exponential an exponent.
struct Growth {
  double exponent = 0, rate = 0;
};

/// The growth of `values` at increasing `times`, which count from the start of the run. Samples at t <= 0 and
/// those before the first non-zero value are left out. Returns nothing where fewer than eight samples are
/// left, where they span less than a factor of four in time, or where a value is not finite.
std::optional<Growth> growth(const std::vector<double>& times, const std::vector<double>& values);

}  // namespace pfaff
