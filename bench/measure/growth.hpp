// How a residual that starts at round-off grows: the power of time, and the rate, of the largest value so
// far.
#pragma once

#include <optional>
#include <vector>

namespace pfaff {

/// Of r(t) = the largest value up to t: the slope of log r over log t, every stretch of log t counting alike,
/// and the slope of log r over t, every stretch of t counting alike, in 1/[t]. Both are descriptions, not
/// tests: a power law has a rate and an exponential an exponent.
struct Growth {
  double exponent = 0, rate = 0;
};

/// Values at increasing times t > 0 after the start; those before the first positive value are left out.
/// Nothing with fewer than eight left, or where they span less than a factor of four in time, or where a
/// value is not finite.
std::optional<Growth> growth(const std::vector<double>& times, const std::vector<double>& values);

}  // namespace pfaff
