// The rules by which a drift gets its class, where a fit alone gives the wrong one: series that imitate runs,
// most of them misjudged before there was a rule.
#include <string>

#include "drift_series.hpp"

namespace {
using namespace pfaff::testing::drift;

/// The class of a series whose quantity has the scale 1 in double, a step for each sample.
Drift measure_scaled(std::size_t samples, const std::function<double(double)>& error, double scale = 1) {
  DriftAccumulator drift;
  for (std::size_t k = 0; k < samples; ++k) drift.add(double(k), error(double(k)));
  return drift.result({0x1p-53, scale, std::int64_t(samples) - 1});
}

TEST(DriftRules, RoundOffIsNoTrend) {
  // A slope of 6e-18 with values of round-off; an exponential was seen in it.
  Noise noise{std::mt19937_64(4)};
  const auto tiny = [&](double t) { return 6e-18 * t / 10 + 1e-16 * std::round(noise()); };
  EXPECT_CLASS(measure_scaled(2000, tiny), "round-off");
  // The same size is no round-off of a quantity that is a thousand times smaller.
  EXPECT_NE(to_string(measure_scaled(2000, tiny, 1e-3).drift_class), "round-off");
  // Few levels, next to each other.
  EXPECT_CLASS(measure_scaled(
                   201, [](double t) { return 0x1p-53 * 2 * std::floor(t / 8) * 10; }, 10),
               "round-off");
  // Roundings to one side, .05 units a step: gone in quad, whose unit is smaller.
  const auto biased = [&](double t) { return 0.05 * 0x1p-53 * t + 0x1p-53 * noise(); };
  const Drift found = measure_scaled(100000, biased);
  EXPECT_CLASS(found, "biased-round-off");
  EXPECT_NE(found.evidence.find("units of round-off a step"), std::string::npos) << found.evidence;
  EXPECT_CLASS(measure(100000, biased), "linear");  // control: without a scale nothing is round-off
}

TEST(DriftRules, ATrendBelowAPerCentOfTheOscillationIsBounded) {
  const auto swing = [](double share) {
    return measure(5000,
                   [=](double t) { return 1.3e-9 * (1 - std::cos(t / 3)) + share * 1.3e-9 * t / 5000; });
  };
  EXPECT_CLASS(swing(3e-5), "bounded");  // 4e-14 under 1.3e-9
  EXPECT_CLASS(swing(0.005), "bounded");
  EXPECT_CLASS(swing(0.05), "linear");
}

TEST(DriftRules, OneSwingIsUndetermined) {
  for (const double periods : {0.4, 0.5, 0.6, 0.8, 1.0}) {
    const Drift drift =
        measure(400, [=](double t) { return 1e-4 * (1 - std::cos(2 * pi * periods * t / 400)); });
    EXPECT_CLASS(drift, "undetermined") << periods << ' ' << drift.evidence;
  }
}

TEST(DriftRules, LosingEverythingIsSaid) {
  // An energy 1 that friction of the method takes away: the error levels off at -1.
  const Drift lost = measure_scaled(2000, [](double t) { return std::expm1(-t / 400); });
  EXPECT_CLASS(lost, "linear");
  EXPECT_NE(lost.evidence.find("loses"), std::string::npos) << lost.evidence;
  // Controls: a shift within the quantity is none of its loss. It is bounded where the error goes on to
  // oscillate, and where nothing moves any more not known to be.
  const auto shift = [](double t) { return 0.1 * std::expm1(-t / 100); };
  EXPECT_CLASS(measure_scaled(2000, [&](double t) { return shift(t) + 0.01 * std::sin(t); }), "bounded");
  EXPECT_CLASS(measure_scaled(2000, shift), "undetermined");
}

TEST(DriftRules, BlowingUpIsNoWalk) {
  const Drift finite = measure_scaled(500, [](double t) { return 1e-3 * std::exp(std::exp(t / 90)); });
  EXPECT_CLASS(finite, "exponential") << finite.evidence;
  const Drift beyond =
      measure_scaled(500, [](double t) { return t < 480 ? 1e-3 * std::exp(t / 8) : infinity; });
  EXPECT_CLASS(beyond, "exponential") << beyond.evidence;
  EXPECT_EQ(beyond.non_finite_time, 480.0);
}

TEST(DriftRules, EveryGrowingClassExcludesNoGrowth) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Drift drift = measure(autoregression(seed, 400, 0.9, 2e-3));
    const auto name = to_string(drift.drift_class);
    EXPECT_FALSE(name == "linear" && covers(drift, 0)) << seed;
    EXPECT_FALSE(name == "polynomial" && !(drift.exponent.value().low > 0)) << seed;
    EXPECT_FALSE(name == "exponential" && !(drift.rate.value().low > 0)) << seed;
  }
}

TEST(DriftRules, EvidenceIsOneLineWithoutACommaAndAlwaysThere) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Drift drift = measure(autoregression(seed, 300, seed % 2 == 0 ? 1 : 0.5, seed % 3 == 0 ? 0.1 : 0));
    EXPECT_FALSE(drift.evidence.empty());
    EXPECT_EQ(drift.evidence.find_first_of(",\n"), std::string::npos) << drift.evidence;
  }
}

}  // namespace
