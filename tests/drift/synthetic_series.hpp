// synthetic_series: errors whose class is known because it was put in, to measure how often the classifier of
// runs/support/drift.hpp is right. Nothing of the classifier is used here.
//
// A series has n samples at s = k/n, n log-uniform in 100 ... 2000, or in given limits. `fast` stands for a
// sum of 1 to 5 sines of 10 ... n/4 periods with random phases and weights, scaled to amplitude 1; `slow` for
// one of 3 ... 15 periods; `noise` for independent normal values of 0 ... 30 % of the oscillation's rms.
// Amplitudes a are log-uniform.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace pfaff::testing {

/// One kind of series.
struct SeriesKind {
  std::string_view name;      // for tables
  std::string_view contents;  // what it is made of
  std::string_view expected;  // the class, by its name in files
  double required;            // per cent that must be right: 2 points below what a prototype reached
};

inline constexpr std::array<SeriesKind, 15> series_kinds{{
    {"bounded", "fast + noise", "bounded", 96.6},
    {"bounded, slow", "slow + noise", "bounded", 95.4},
    {"AR(1)", "first-order autoregression with a correlation time below T/30", "bounded", 97.1},
    {"levels off", "1 - exp(-s/tau), tau .01 ... .1, + a fast + noise, a .01 ... 1", "bounded", 93.4},
    {"random walk", "running sum of normal values", "random-walk", 85.4},
    {"linear", "s + a fast + noise, a .01 ... 5", "linear", 96.7},
    {"linear, slow", "s + a slow + noise, a .01 ... .3", "linear", 93.6},
    {"t cos wt", "s cos of 20 periods and more + noise", "linear", 97.6},
    {"power", "s^p, p 1.4 ... 4, + a fast + noise, a .003 ... .3", "polynomial", 92.0},
    {"exponential",
     "exp(lambda s) (1 + b fast) + a fast + noise, lambda 4 ... 25, b .01 ... .2, a 1e-6 ... .001 of the end",
     "exponential", 93.7},
    {"round-off", "running sum of roundings of at most 3 units", "round-off", 98.0},
    {"part of a period", "sine of .15 ... 1.2 periods + noise", "undetermined", 87.9},
    {"part, fast", "sine of .6 ... 1.2 periods + a fast + noise, a .1 ... 1", "undetermined", 95.0},
    {"beats", "x + c x^2, c .05 ... 2, x two sines whose beat has 2 ... 8 periods, + noise", "bounded", 90.0},
    {"part of a beat", "the same, of .3 ... 2 periods of the beat", "bounded", 50.0},
}};

/// A series and what is known of it.
struct SyntheticSeries {
  std::vector<double> times, errors;
  std::optional<double> slope, exponent, rate;  // per unit of time, the run lasting from 0 to its length
  double unit = 0, scale = 0;                   // of round-off; 0 where it plays no part
};

/// Series number `seed` of a kind; the same for the same numbers.
SyntheticSeries make_series(std::size_t kind, std::uint64_t seed, std::size_t fewest = 100,
                            std::size_t most = 2000);

}  // namespace pfaff::testing
