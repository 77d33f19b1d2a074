// Growth of residuals: made-up series with a known power or rate give that power or rate back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <pfaff/runs/support/growth.hpp>

namespace {
using pfaff::Growth;
using pfaff::GrowthFit;

struct Samples {
  std::vector<double> times, values;
};
template <class F>
Samples sampled(F&& f, int count = 200) {
  Samples s;
  for (int k = 0; k <= count; ++k) {
    s.times.push_back(0.1 * k);
    s.values.push_back(f(0.1 * k));
  }
  return s;
}

std::optional<Growth> growth(const std::vector<double>& times, const std::vector<double>& values) {
  GrowthFit fit;
  for (std::size_t k = 0; k < times.size(); ++k) fit.add(times[k], values[k]);
  return fit.growth();
}

TEST(Growth, PowersAndRates) {
  for (const double power : {0.5, 1.0, 2.0}) {
    const auto s = sampled([&](double t) { return 1e-9 * std::pow(t, power); });
    EXPECT_NEAR(growth(s.times, s.values)->exponent, power, 1e-12);  // rounding of logarithms
  }
  const auto s = sampled([](double t) { return 1e-12 * std::exp(0.7 * t); });
  EXPECT_NEAR(growth(s.times, s.values)->rate, 0.7, 1e-12);
}

TEST(Growth, SeesTheLargestSoFarAndNoSigns) {
  const auto s = sampled([](double t) { return -1e-9 * t * std::abs(std::sin(40 * t)); });
  EXPECT_NEAR(growth(s.times, s.values)->exponent, 1, 0.1);  // maxima are met to within a tenth
  const auto level = sampled([](double) { return 3e-16; });
  EXPECT_NEAR(growth(level.times, level.values)->exponent, 0, 1e-12);
}

// An error that has come back near zero at the end has still been as large as it was.
TEST(Growth, DoesNotForgetWhatComesBack) {
  const auto back = sampled([](double t) { return t < 10 ? 1e-9 * t : 1e-15; }),
             stayed = sampled([](double t) { return 1e-9 * std::min(t, 9.9); });
  const auto found = growth(back.times, back.values), expected = growth(stayed.times, stayed.values);
  EXPECT_NEAR(found->exponent, expected->exponent, 1e-9);
  EXPECT_NEAR(found->rate, expected->rate, 1e-9);
}

TEST(Growth, NothingWhereThereIsNothingToSay) {
  EXPECT_FALSE(growth({}, {}));
  const auto zero = sampled([](double) { return 0.0; });
  EXPECT_FALSE(growth(zero.times, zero.values));
  const auto few = sampled([](double t) { return t; }, 7);
  EXPECT_FALSE(growth(few.times, few.values));
  auto lost = sampled([](double t) { return t; });
  lost.values.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(growth(lost.times, lost.values));
}

}  // namespace
