// How often the drift classifier is right on synthetic series of each kind, with fewer series than
// tests/drift/error_rates.cpp takes for the table of docs/drift-and-cost.md.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <pfaff/runs/support/drift.hpp>

#include "../drift/synthetic_series.hpp"

namespace {

using pfaff::Drift;
using pfaff::DriftAccumulator;
namespace synthetic = pfaff::testing;

TEST(DriftRates, EveryKindIsRightAsOftenAsTheDocsSay) {
  constexpr int series = 100;
  for (std::size_t kind = 0; kind < synthetic::series_kinds.size(); ++kind) {
    const synthetic::SeriesKind& k = synthetic::series_kinds[kind];
    int right = 0;
    for (int seed = 0; seed < series; ++seed) {
      const synthetic::SyntheticSeries s = synthetic::make_series(kind, std::uint64_t(seed));
      DriftAccumulator accumulator;
      for (std::size_t i = 0; i < s.errors.size(); ++i) accumulator.add(s.times[i], s.errors[i]);
      const Drift drift = accumulator.result({s.unit, s.scale, std::int64_t(s.errors.size()) - 1});
      right += to_string(drift.drift_class) == k.expected;
    }
    // What is required of many series is not refuted by this many: two binomial standard deviations below it,
    // and one series, are allowed. 100 series of a rate of 96 % lie above 91 % with a probability of 97.5 %.
    const double rate = k.required / 100;
    const double least = series * rate - 2 * std::sqrt(series * rate * (1 - rate)) - 1;
    EXPECT_GE(right, least) << k.name << ": " << k.contents;
  }
}

}  // namespace
