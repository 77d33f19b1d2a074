// The measured exponent of a walk, on walks whose exponent is known: fractional Brownian motion, made by
// Cholesky's factors of its covariance (t^2H + s^2H - |t - s|^2H)/2.
#include <pfaff/runs/support/walk_exponent.hpp>

#include "drift_series.hpp"

namespace {
using namespace pfaff::testing::drift;
using pfaff::windows::Estimate;

constexpr std::size_t samples = 320;

class Walks {
 public:
  explicit Walks(double exponent) : lower_(samples * samples) {
    const auto power = [=](double t) { return std::pow(t, 2 * exponent); };
    for (std::size_t i = 0; i < samples; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        const double t = double(i + 1), s = double(j + 1);
        double sum = (power(t) + power(s) - power(t - s)) / 2;
        for (std::size_t k = 0; k < j; ++k) sum -= lower_[i * samples + k] * lower_[j * samples + k];
        lower_[i * samples + j] = i == j ? std::sqrt(sum) : sum / lower_[j * samples + j];
      }
  }
  Estimate measured(std::uint64_t seed, double noise) const {
    Noise random{std::mt19937_64(seed)};
    std::vector<double> steps(samples);
    for (double& x : steps) x = random();
    DriftAccumulator errors;
    for (std::size_t i = 0; i < samples; ++i) {
      double e = noise * random();
      for (std::size_t j = 0; j <= i; ++j) e += lower_[i * samples + j] * steps[j];
      errors.add(double(i), e);
    }
    const auto series = pfaff::windows::on_scaled_time(errors.blocks(), 0, double(samples - 1));
    return pfaff::windows::walk_exponent(pfaff::windows::over_windows(series, 31).mean);
  }

 private:
  std::vector<double> lower_;
};

TEST(WalkExponent, IsMeasuredAndItsIntervalHolds) {
  constexpr int walks = 100;
  for (const double exponent : {0.3, 0.5, 0.7, 0.85})
    for (const double noise : {0.0, 1.0}) {
      const Walks of(exponent);
      int held = 0;
      double mean = 0, half_width = 0;
      for (std::uint64_t seed = 0; seed < walks; ++seed) {
        const Estimate e = of.measured(seed, noise);
        held += e.low <= exponent && exponent <= e.high;
        mean += e.value / walks;
        half_width += (e.high - e.low) / 2 / walks;
      }
      // 95 % by name; two binomial standard deviations below that, and one walk. The bias is within half of
      // the spread of single walks, .14.
      EXPECT_GE(held, 90) << exponent << ' ' << noise;
      EXPECT_NEAR(mean, exponent, 0.07) << exponent << ' ' << noise;
      EXPECT_LT(half_width, 0.4) << exponent << ' ' << noise;
    }
}

// Control: the exponent of one walk is not that of another kind.
TEST(WalkExponent, TellsWalksApart) {
  const Walks slow(0.3), fast(0.85);
  int apart = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    apart += slow.measured(seed, 0).value < 0.575;
    apart += fast.measured(seed, 0).value > 0.575;
  }
  // Half way is two standard deviations, .14, away: 78 of 80, less three binomial standard deviations.
  EXPECT_GE(apart, 73);
}

// Units and a constant do not matter.
TEST(WalkExponent, HasNoUnit) {
  std::vector<double> means = autoregression(7, 31, 1), others = means;
  for (double& x : others) x = 1e-9 * x + 3e-7;
  const Estimate one = pfaff::windows::walk_exponent(means), other = pfaff::windows::walk_exponent(others);
  EXPECT_EQ(one.value, other.value);
  EXPECT_EQ(one.low, other.low);
  EXPECT_EQ(one.high, other.high);
}

TEST(WalkExponent, StandsInTheDrift) {
  int named = 0;
  double least = 1, largest = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Drift drift = measure(autoregression(seed, 1000, 1));
    if (to_string(drift.drift_class) != "random-walk") continue;
    ++named;
    ASSERT_TRUE(drift.exponent.has_value());
    EXPECT_LT(drift.exponent->low, drift.exponent->value);
    EXPECT_GT(drift.exponent->high, drift.exponent->value);
    least = std::min(least, drift.exponent->value);
    largest = std::max(largest, drift.exponent->value);
  }
  EXPECT_GE(named, 12);
  EXPECT_GT(largest - least, 0.1);  // of a constant: 0
}

}  // namespace
