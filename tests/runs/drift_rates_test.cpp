// How often the drift classifier is right on synthetic series of each kind, with fewer series than
// tests/drift/error_rates.cpp takes for the table of docs/drift-and-cost.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <pfaff/runs/support/drift.hpp>

#include "../drift/synthetic_series.hpp"

namespace {

using pfaff::Drift;
using pfaff::DriftAccumulator;
namespace synthetic = pfaff::testing;

Drift drift_of(std::size_t kind, int seed) {
  const synthetic::SyntheticSeries s = synthetic::make_series(kind, std::uint64_t(seed));
  DriftAccumulator accumulator;
  for (std::size_t i = 0; i < s.errors.size(); ++i) accumulator.add(s.times[i], s.errors[i]);
  return accumulator.result({s.unit, s.scale, std::int64_t(s.errors.size()) - 1});
}

TEST(DriftRates, EveryKindIsRightAsOftenAsTheDocsSay) {
  constexpr int series = 100;
  for (std::size_t kind = 0; kind < synthetic::series_kinds.size(); ++kind) {
    const synthetic::SeriesKind& k = synthetic::series_kinds[kind];
    int right = 0;
    for (int seed = 0; seed < series; ++seed)
      right += to_string(drift_of(kind, seed).drift_class) == k.expected;
    // What is required of many series is not refuted by this many: two binomial standard deviations below it,
    // and one series, are allowed. 100 series of a rate of 96 % lie above 91 % with a probability of 97.5 %.
    const double rate = k.required / 100;
    const double least = series * rate - 2 * std::sqrt(series * rate * (1 - rate)) - 1;
    EXPECT_GE(right, least) << k.name << ": " << k.contents;
  }
}

// Where less than two periods of a beat are seen the error may be left undetermined, but it is no drift. The
// docs say that 4 % are called one: of 100 series so many lie below 9 with a probability of 97.5 %. Without
// what the rules know of beats there are 20.
TEST(DriftRates, PartsOfBeatsAreSeldomCalledADrift) {
  const auto& kinds = synthetic::series_kinds;
  const auto kind = std::size_t(
      std::find_if(kinds.begin(), kinds.end(), [](const auto& k) { return k.name == "part of a beat"; }) -
      kinds.begin());
  int called = 0;
  for (int seed = 0; seed < 100; ++seed) {
    const pfaff::DriftClass found = drift_of(kind, seed).drift_class;
    called += found != pfaff::DriftClass::bounded && found != pfaff::DriftClass::undetermined;
  }
  EXPECT_LE(called, 8);
}

}  // namespace
