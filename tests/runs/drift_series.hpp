// Series whose drift is known, and what the estimator makes of them.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <pfaff/runs/support/drift.hpp>

namespace pfaff::testing::drift {

using pfaff::Drift;
using pfaff::DriftAccumulator;
using pfaff::DriftClass;
using pfaff::to_string;

inline constexpr double pi = std::numbers::pi;
inline constexpr double infinity = std::numeric_limits<double>::infinity();

inline Drift measure(const std::vector<double>& errors, double step = 1) {
  DriftAccumulator drift;
  for (std::size_t k = 0; k < errors.size(); ++k) drift.add(step * double(k), errors[k]);
  return drift.result();
}

/// errors of the function at 0, 1, ... samples - 1
inline Drift measure(std::size_t samples, const std::function<double(double)>& error) {
  DriftAccumulator drift;
  for (std::size_t k = 0; k < samples; ++k) drift.add(double(k), error(double(k)));
  return drift.result();
}

struct Noise {
  std::mt19937_64 generator;
  std::normal_distribution<double> normal{};
  double operator()() { return normal(generator); }
};

/// x_(k+1) = phi x_k + noise; from its stationary distribution, a random walk (phi = 1) from zero.
inline std::vector<double> autoregression(std::uint64_t seed, std::size_t samples, double phi,
                                          double slope = 0) {
  Noise noise{std::mt19937_64(seed)};
  double x = phi < 1 ? noise() / std::sqrt(1 - phi * phi) : 0;
  std::vector<double> errors(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    errors[k] = x + slope * double(k);
    x = phi * x + noise();
  }
  return errors;
}

inline bool covers(const Drift& drift, double x) { return drift.slope_low <= x && x <= drift.slope_high; }

#define EXPECT_CLASS(drift, name) EXPECT_EQ(to_string((drift).drift_class), name)

}  // namespace pfaff::testing::drift
