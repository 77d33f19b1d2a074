// Errors that come many at a time: the same classes as one by one, and no digit that depends on how they
// come.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <pfaff/runs/support/drift.hpp>

namespace {
using pfaff::Drift;
using pfaff::DriftAccumulator;

constexpr double h = 0.01, t0 = 3;
constexpr pfaff::RoundOff round_off{0x1p-53, 1, 100000};

// Errors of runs: bounded, drifting, growing, a walk of roundings, few values, one that is lost.
std::vector<std::vector<double>> series(std::size_t count) {
  std::vector<std::vector<double>> all;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  double walk = 0;
  const std::vector<std::function<double(double)>> laws{
      [](double t) { return 1e-4 * std::sin(7 * t); },
      [](double t) { return 1e-9 * t + 1e-6 * std::sin(3 * t); },
      [](double t) { return 1e-12 * t * t; },
      [&](double) { return walk += 1e-16 * normal(random); },
      [](double t) { return 0x1p-53 * std::round(3 * std::sin(t)); },
      [](double t) { return 1e-3 * std::exp(0.01 * t) * std::cos(5 * t); },
      [](double) { return 0.0; }};
  for (const auto& law : laws) {
    all.emplace_back();
    for (std::size_t k = 0; k < count; ++k) all.back().push_back(law(t0 + static_cast<double>(k) * h));
  }
  return all;
}

Drift in_groups(const std::vector<double>& errors, const std::vector<std::size_t>& sizes) {
  DriftAccumulator drift;
  std::size_t done = 0;
  for (std::size_t turn = 0; done < errors.size(); ++turn) {
    const std::size_t some = std::min(sizes[turn % sizes.size()], errors.size() - done);
    drift.add(t0, h, static_cast<std::int64_t>(done), 1, std::span(errors).subspan(done, some));
    done += some;
  }
  return drift.result(round_off);
}
Drift one_by_one(const std::vector<double>& errors) {
  DriftAccumulator drift;
  for (std::size_t k = 0; k < errors.size(); ++k) drift.add(t0 + static_cast<double>(k) * h, errors[k]);
  return drift.result(round_off);
}

void expect_same(const Drift& one, const Drift& other) {
  EXPECT_EQ(one.drift_class, other.drift_class);
  EXPECT_EQ(one.evidence, other.evidence);
  EXPECT_EQ(one.samples, other.samples);
  EXPECT_EQ(one.maximum, other.maximum);
  EXPECT_EQ(one.rms, other.rms);
  EXPECT_EQ(one.final_value, other.final_value);
  EXPECT_EQ(one.slope, other.slope);
  EXPECT_EQ(one.slope_low, other.slope_low);
  EXPECT_EQ(one.slope_high, other.slope_high);
  EXPECT_EQ(one.oscillation_amplitude, other.oscillation_amplitude);
  EXPECT_EQ(one.oscillation_rms, other.oscillation_rms);
}

TEST(DriftGroups, NoDigitDependsOnHowErrorsCome) {
  for (const std::size_t count : {100U, 9001U, 70001U})
    for (const auto& errors : series(count)) {
      const Drift whole = in_groups(errors, {errors.size()});
      for (const std::vector<std::size_t>& sizes :
           {std::vector<std::size_t>{1}, {7}, {256}, {255, 1, 300}, {16, 4000}, {40000}})
        expect_same(in_groups(errors, sizes), whole);
    }
}

// Sums and times are rounded in another order: means agree to what 70000 roundings make, 1e-11 of the sizes
// that they are made of, slopes to the rounding of times, 1e-9. Extremes, counts and classes are the same.
TEST(DriftGroups, AgreeWithErrorsOneByOne) {
  for (const std::size_t count : {40U, 9001U, 70001U})
    for (const auto& errors : series(count)) {
      const Drift together = in_groups(errors, {errors.size()}), apart = one_by_one(errors);
      const double span = h * static_cast<double>(count);
      EXPECT_EQ(together.drift_class, apart.drift_class) << count << " " << errors[count / 2];
      EXPECT_EQ(together.samples, apart.samples);
      EXPECT_EQ(together.maximum, apart.maximum);
      EXPECT_EQ(together.final_value, apart.final_value);
      EXPECT_NEAR(together.rms, apart.rms, 1e-11 * apart.maximum);
      EXPECT_NEAR(together.slope, apart.slope, 1e-9 * apart.maximum / span);
      EXPECT_NEAR(together.oscillation_rms, apart.oscillation_rms, 1e-7 * apart.maximum);
      EXPECT_NEAR(together.oscillation_amplitude, apart.oscillation_amplitude, 1e-10 * apart.maximum);
    }
}

// Where a number is not finite nothing behind it counts, however it comes.
TEST(DriftGroups, EndAtWhatIsNotFinite) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e200}) {
    std::vector<double> errors(1000, 1e-3);
    errors[600] = bad;
    const Drift drift = in_groups(errors, {97});
    EXPECT_EQ(drift.samples, 600U);
    EXPECT_GE(drift.non_finite, 1U);
    EXPECT_NEAR(drift.non_finite_time.value_or(0), t0 + 600 * h, 1e-12);
  }
}

// A gap in the steps, and errors at times of their own, begin a new group.
TEST(DriftGroups, MayBeMixed) {
  std::vector<double> errors(400);
  for (std::size_t k = 0; k < errors.size(); ++k) errors[k] = std::sin(static_cast<double>(k));
  DriftAccumulator drift;
  drift.add(t0, h, 0, 1, std::span(errors).first(100));
  drift.add(t0 + 100 * h, errors[100]);
  drift.add(t0, h, 101, 1, std::span(errors).subspan(101));
  const Drift apart = one_by_one(errors);
  const Drift mixed = drift.result(round_off);
  EXPECT_EQ(mixed.samples, 400U);
  EXPECT_EQ(mixed.drift_class, apart.drift_class);
  EXPECT_EQ(mixed.maximum, apart.maximum);
  EXPECT_NEAR(mixed.slope, apart.slope, 1e-12);
}

}  // namespace
