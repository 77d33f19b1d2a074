// No silent nonsense: steps and tolerances that mean nothing are refused, and a run in which something is not
// finite says so, with its step and time.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/bench/runner/record.hpp>

#include "run_settings.hpp"

namespace pfaff {
namespace {

using testing::complaint;
using testing::settings_of;

RunRecord executed(const RunSettings& settings) {
  const ResolvedRun run = resolve(settings);
  return execute(run, reference_asked_for(run).get());
}
void expect_said(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
}

TEST(Nonsense, AStepThatRoundsToZero) {
  RunSettings s = settings_of("kepler", "1e-400", "1e-398");
  expect_said(complaint(s), {"--step: 1e-400", "rounds to 0 in double precision", "--precision quad"});
  s.precision = Precision::quad;
  EXPECT_EQ(complaint(s), "");
}

TEST(Nonsense, AStepThatVanishesBesideTheTime) {
  RunSettings s = settings_of("kepler", "1e-13", "1e-11");
  s.t0 = "1e4";  // where neighbouring doubles are 1.8e-12 apart
  expect_said(complaint(s), {"--step: 1e-13", "vanishes beside the time 10000", "t + h = t"});
  s.t0 = "-1e4";
  expect_said(complaint(s), {"vanishes beside the time 10000"});
  s.precision = Precision::quad;
  EXPECT_EQ(complaint(s), "");
  s.precision = Precision::double_precision;
  s.t0 = "1";
  EXPECT_EQ(complaint(s), "");
  // The end counts as well as the start.
  s = settings_of("kepler", "1e-4", "1");
  s.t0 = "1e13";
  expect_said(complaint(s), {"vanishes"});
  s.step.clear();
  s.integrator = "odeint-dopri5";
  s.tolerance = "1e-6";
  s.time = "1e-4";
  expect_said(complaint(s), {"--time: 1e-4", "vanishes beside the time"});
}

TEST(Nonsense, AToleranceBelowRoundOff) {
  RunSettings s = settings_of("kepler", "", "1");
  s.integrator = "odeint-dopri5";
  for (const char* below : {"1e-16", "2.2e-16", "1e-300"}) {
    s.tolerance = below;
    expect_said(complaint(s), {std::string("--tolerance: ") + below, "below round-off", "2.22e-16"});
  }
  s.tolerance = "2.3e-16";
  EXPECT_EQ(complaint(s), "");
  // In quad round-off is smaller, where the method knows quad.
  s.precision = Precision::quad;
  expect_said(complaint(s), {"odeint-dopri5", "double only", "--precision double"});
  s.integrator = "odeint-bulirsch-stoer";
  expect_said(complaint(s), {"odeint-bulirsch-stoer chooses its steps in double only", "--precision double"});
  s.integrator = "extrapolation";
  s.tolerance = "1e-30";
  EXPECT_EQ(complaint(s), "");
  s.tolerance = "1e-34";
  expect_said(complaint(s), {"--tolerance: 1e-34", "below round-off", "1.93e-34"});
  s.precision = Precision::double_precision;
  expect_said(complaint(s), {"below round-off", "or --precision quad"});
}

TEST(Nonsense, MoreStepsThanTheBudget) {
  RunSettings s = settings_of("kepler", "0.01", "10");
  s.step_budget = 999;
  expect_said(complaint(s), {"--step: 0.01 is too small", "1e+03 steps", "at most 999", "--max-steps"});
  s.step_budget = 1000;
  EXPECT_EQ(complaint(s), "");
  expect_said(complaint(settings_of("kepler", "1e-9", "1e6")), {"1e+15 steps", "1000000000000"});
  // Where the method chooses its steps, the run ends.
  s = settings_of("kepler", "", "1000");
  s.integrator = "odeint-dopri5";
  s.tolerance = "1e-10";
  s.step_budget = 500;
  const RunRecord record = executed(s);
  EXPECT_EQ(record.status, Status::not_converged);
  EXPECT_EQ(record.completed, 500);
  expect_said(record.message, {"the budget of 500 steps has run out at t = ", "--max-steps"});
}

// e^{nu t} leaves the range of doubles at t = 473, when the state has long gone to zero.
TEST(Nonsense, AnInvariantThatIsNotFiniteEndsTheRun) {
  const RunRecord record = executed(settings_of("damped-oscillator", "0.1", "1e4", {{"nu", "1.5"}}));
  EXPECT_EQ(record.status, Status::non_finite);
  EXPECT_NEAR(static_cast<double>(record.completed), 10 * 709.78 / 1.5, 2);
  expect_said(record.message, {"the invariant birkhoffian is not finite", "at t = 473.",
                               "(step " + std::to_string(record.completed + 1) + ")"});
  for (const Sample& sample : record.samples)
    for (const Quad& value : sample.invariants) EXPECT_TRUE(isfinite(value));
  for (const Drift& drift : record.drift) EXPECT_TRUE(std::isfinite(drift.maximum));
  // Control: the run that ends before.
  const RunRecord shorter = executed(settings_of("damped-oscillator", "0.1", "470", {{"nu", "1.5"}}));
  EXPECT_EQ(shorter.status, Status::converged);
  EXPECT_EQ(shorter.completed, 4700);
}

// A parabolic orbit, which the closed form of ellipses does not know.
TEST(Nonsense, AnErrorThatIsNotFiniteEndsTheRun) {
  RunSettings s = settings_of("kepler", "0.1", "10", {{"initial", "2,0,0,1"}});
  const RunRecord record = executed(s);
  EXPECT_EQ(record.status, Status::non_finite);
  EXPECT_EQ(record.completed, 0);
  EXPECT_FALSE(record.error_max.has_value());
  expect_said(record.message, {"the error against the exact solution", "is not finite", "at t = 0 (step 0)"});
  s.reference = ErrorsAgainst::none;
  EXPECT_EQ(executed(s).status, Status::converged);
  s.reference = ErrorsAgainst::exact;
  s.set = {{"initial", "1,0,0,1"}};
  EXPECT_EQ(executed(s).status, Status::converged);
}

TEST(Nonsense, AtRestTheErrorIsZero) {
  const RunRecord record = executed(settings_of("harmonic-oscillator", "0.1", "1", {{"initial", "0,0"}}));
  EXPECT_EQ(record.status, Status::converged);
  EXPECT_EQ(record.error_max, 0.0);
}

// A quantity that leaves the range of doubles in a run in quad.
struct Runaway {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[0];
    rate[1] = -z[1];
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[0];
  }
};

const System<Runaway> registered{{.name = "test-runaway",
                                  .title = "a test",
                                  .reference = "su-qin",
                                  .coordinates = {{"x", "m"}, {"y", "m"}},
                                  .initial = {1, 1},
                                  .invariants = {conserved("x", "m")}}};

TEST(Nonsense, ADriftThatIsNotFiniteEndsTheRun) {
  RunSettings s = settings_of("test-runaway", "0.1", "720");
  s.precision = Precision::quad;
  const RunRecord record = executed(s);
  EXPECT_EQ(record.status, Status::non_finite);
  expect_said(record.message, {"the drift of x is not finite", "at t = 709."});
  EXPECT_TRUE(std::isfinite(record.drift[0].maximum));
  s.time = "700";
  EXPECT_EQ(executed(s).status, Status::converged);
}

// Errors whose squares cannot be summed are not left out of the maximum. x is e^t.
TEST(Nonsense, TheMaximumIsThatOfAllErrors) {
  const RunRecord record = executed(settings_of("test-runaway", "0.1", "400"));
  EXPECT_EQ(record.status, Status::converged);
  const double last = static_cast<double>(record.samples.back().invariants[0]);
  EXPECT_GT(last, 1e170);
  EXPECT_EQ(record.drift[0].maximum, last - 1);
  EXPECT_EQ(record.drift[0].final_value, last - 1);
  EXPECT_TRUE(std::isinf(record.drift[0].rms));
  EXPECT_EQ(record.drift[0].drift_class, DriftClass::exponential);
}

TEST(Nonsense, AStopEndsTheRunAfterItsStep) {
  std::atomic<bool> stop{false};
  RunSettings s = settings_of("kepler", "0.1", "100");
  const ResolvedRun run = resolve(s);
  const RunRecord whole = execute(run, nullptr);
  const auto stopping = [&](double fraction) { stop = fraction >= 0.25; };
  const RunRecord record = execute(run, nullptr, stopping, &stop);
  EXPECT_TRUE(record.interrupted);
  EXPECT_FALSE(whole.interrupted);
  expect_said(record.message, {"interrupted at t = ", "(step " + std::to_string(record.completed) + ")"});
  EXPECT_NEAR(static_cast<double>(record.completed), 250, 2);
  ASSERT_EQ(record.samples.size(), static_cast<std::size_t>(record.completed) + 1);
  for (std::size_t k = 0; k < record.samples.size(); ++k)
    EXPECT_EQ(record.samples[k].state, whole.samples[k].state) << k;
  EXPECT_EQ(summary(run, record)["status"], "interrupted");
}

}  // namespace
}  // namespace pfaff
