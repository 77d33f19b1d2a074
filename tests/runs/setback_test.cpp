// Quantities that are expected to move in one direction: what runs report about moves in the opposite one.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/runs/support/setback.hpp>

#include "../bench/kept_samples.hpp"
#include "../bench/run_settings.hpp"

namespace {

using namespace pfaff;
using pfaff::testing::settings_of;

TEST(Setback, IsTheLargestMoveAgainstTheExpectedDirection) {
  const std::vector<double> values{5, 3, 4, 1, 1.5, std::nan("")};
  const auto largest = [&](Behaviour behaviour) {
    Setback<double> setback(behaviour);
    for (const double x : values) setback.add(x);
    return setback.largest();
  };
  EXPECT_EQ(largest(Behaviour::decreasing), 1);  // from 3 to 4
  EXPECT_EQ(largest(Behaviour::increasing), 4);  // from 5 to 1
  EXPECT_EQ(largest(Behaviour::conserved), 0);
  EXPECT_EQ(largest(Behaviour::free), 0);
}

// q = cos t from 1 on: its position falls and never rises until t = pi, whatever it is declared to do.
struct FallingOscillator {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = values[1] = z[0];
  }
};

TEST(Setback, RunsMeasureBothDirections) {
  ResolvedRun run = resolve(settings_of("harmonic-oscillator", "0.01", "3"));
  run.model = make_model(SystemDescriptor{.name = "oscillator",
                                          .title = "",
                                          .reference = "",
                                          .coordinates = {{"q", "m"}, {"p", "m/s"}},
                                          .initial = {1, 0},
                                          .invariants = {{"falling", "m", Behaviour::decreasing},
                                                         {"rising", "m", Behaviour::increasing}}},
                         FallingOscillator{});
  run.initial = {1, 0};
  const nlohmann::json j = summary(run, pfaff::testing::execute_and_keep(run, nullptr));
  EXPECT_EQ(j["invariants"][0]["largest_rise"], 0.0);
  EXPECT_FALSE(j["invariants"][0].contains("largest_fall"));
  EXPECT_NEAR(j["invariants"][1]["largest_fall"].get<double>(), 1 - std::cos(3), 1e-9);  // the control
  EXPECT_FALSE(j["invariants"][1].contains("largest_rise"));
  EXPECT_EQ(j["invariants"][1]["expected"], "increasing");

  EXPECT_EQ(measures_of(run, false), (std::vector<std::string>{"falling:rise", "rising:fall"}));
  EXPECT_EQ(measured(j, "falling:rise"), 0.0);
  EXPECT_EQ(measured(j, "rising:fall"), j["invariants"][1]["largest_fall"].get<double>());
  EXPECT_EQ(measured(j, "falling:fall"), std::nullopt);
  EXPECT_EQ(setback_in(j["invariants"][1])->move, "fall");
}

TEST(Setback, EntropyOfARelaxingBodyNeverFalls) {
  const ResolvedRun run = resolve(settings_of("relaxing-rigid-body", "0.01", "3"));
  const pfaff::testing::RecordWithSamples record = pfaff::testing::execute_and_keep(run, nullptr);
  ASSERT_EQ(run.model->invariants()[1].behaviour, Behaviour::increasing);
  EXPECT_EQ(record.invariants().setback[1], 0);
  EXPECT_GT(record.samples.back().invariants[1], record.samples.front().invariants[1]);
}

// The error of an energy that falls, in the series, against the closed solution of the damped oscillator with
// nu = 1/2.
TEST(Setback, TheErrorOfWhatFallsIsWritten) {
  const ResolvedRun run = resolve(settings_of("damped-oscillator", "0.1", "3", {{"nu", "1/2"}}));
  const pfaff::testing::RecordWithSamples record =
      pfaff::testing::execute_and_keep(run, reference_of(run).get());
  const std::string series = pfaff::testing::series_csv(run, reference_of(run).get());
  const std::string header = series.substr(0, series.find('\n'));
  EXPECT_NE(header.find(",error [1],energy:error [m^2/s^2]"), std::string::npos) << header;
  EXPECT_EQ(header.find("birkhoffian:error"), std::string::npos) << header;  // it is conserved
  double worst = 0;
  for (const Sample<Quad>& sample : record.samples) {
    ASSERT_EQ(sample.invariant_errors.size(), 1U);
    const double t = static_cast<double>(sample.t), w = std::sqrt(1 - 0.0625), decay = std::exp(-t / 4);
    const double r = decay * (std::cos(w * t) + std::sin(w * t) / (4 * w)), p = -decay * std::sin(w * t) / w;
    const double error = static_cast<double>(sample.invariants[1]) - (r * r + p * p) / 2;
    EXPECT_NEAR(static_cast<double>(sample.invariant_errors[0]), error, 1e-15)
        << t;  // a few roundings of 1/2
    worst = std::max(worst, std::abs(error));
  }
  EXPECT_GT(worst, 1e-8);  // there is an error to be seen
  // Without a reference solution there is no such column.
  EXPECT_EQ(pfaff::testing::series_csv(run).find(":error"), std::string::npos);
}

}  // namespace
