// No silent nonsense: steps and tolerances that mean nothing are refused, and a run in which something is not
// finite says so, with its step and time.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/bench/runner/record.hpp>

#include "kept_samples.hpp"
#include "run_settings.hpp"

namespace pfaff {
namespace {

using testing::complaint;
using testing::settings_of;

testing::RecordWithSamples executed(const RunSettings& settings) {
  const ResolvedRun run = resolve(settings);
  return testing::execute_and_keep(run, reference_asked_for(run).get());
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

// Doubles are 2^-3 apart at 1e15 and 2^-23 at 1e9: times t + h there are off by half of that.
TEST(Nonsense, AStepThatIsTooLittleBesideTheTime) {
  const auto of = [](const char* t0, const char* step, const char* time) {
    RunSettings s = settings_of("kepler", step, time);
    s.t0 = t0;
    return s;
  };
  for (const RunSettings& s : {of("1e15", "0.1", "10"), of("-1e15", "0.1", "10"), of("1e10", "0.1", "1"),
                               of("1e4", "1e-13", "1e-11"), of("-1e4", "1e-7", "1e-5"),
                               of("0", "1e-3", "1e8"), of("1e9", "0.05", "1")}) {
    expect_said(complaint(s), {"--step: " + s.step, "is too little beside the time", "in double precision",
                               "t + h is off by up to", "--precision quad"});
    EXPECT_EQ(complaint(s).find("an origin of time that is nearer to the run") == std::string::npos,
              s.t0 == "0");
    RunSettings quad = s;
    quad.precision = Precision::quad;
    EXPECT_EQ(complaint(quad), "");
  }
  expect_said(complaint(of("1e15", "0.1", "10")), {"the time 1e+15", "off by up to 0.0625"});
  // A millionth of h is allowed: 2^-24 beside 0.06 and more. Where times are multiples of the spacing,
  // nothing is off.
  for (const RunSettings& s : {of("1e9", "0.06", "1"), of("1e9", "0.1", "10"), of("1e15", "1", "10"),
                               of("1e15", "0.125", "10"), of("1", "1e-9", "1e-7"), of("0", "0.1", "1e6")})
    EXPECT_EQ(complaint(s), "") << s.t0 << ' ' << s.step;
  expect_said(complaint(of("1000000000000000.25", "0.1875", "1.5")), {"is too little beside the time"});
}

// The error of a run is that of its state at t0 + n h, and not at the double next to it: at t = 1e9 that is
// off by up to 6e-8, and so would the error be.
TEST(Nonsense, ErrorsAreMeasuredAtTheTimeOfTheState) {
  RunSettings s = settings_of("harmonic-oscillator", "0.1", "20");
  s.integrator = "gauss";
  s.set = {{"stages", "6"}};
  s.reference = ErrorsAgainst::solution;
  s.t0 = "1e9";
  const testing::RecordWithSamples record = executed(s);
  ASSERT_TRUE(record.error_max.has_value());
  EXPECT_LE(record.error_max.value_or(1), 1e-13);
}

// Runs that choose their steps have samples at 32 to 200 times, which have to be told apart as well.
TEST(Nonsense, ADurationThatIsTooLittleBesideTheTime) {
  RunSettings s = settings_of("kepler", "", "1e-4");
  s.integrator = "odeint-dopri5";
  s.tolerance = "1e-6";
  for (const char* t0 : {"1e13", "-1e13", "1e5"}) {
    s.t0 = t0;
    expect_said(complaint(s), {"--time: 1e-4 is too little beside the time"});
  }
  s.t0 = "1";
  EXPECT_EQ(complaint(s), "");
}

// A tolerance is relative, so that a start at rest in zero says nothing of what counts.
TEST(Nonsense, AStartAtRestInZeroWithoutAbsoluteTolerance) {
  for (const char* method : {"odeint-dopri5", "odeint-bulirsch-stoer", "taylor", "extrapolation"}) {
    RunSettings s = settings_of("harmonic-oscillator", "", "1");
    s.integrator = method;
    s.tolerance = "1e-6";
    s.initial = {"0", "0"};
    expect_said(complaint(s), {"at rest in zero", "expected --absolute"});
    s.absolute = {"0"};
    expect_said(complaint(s), {"at rest in zero"});
    for (const std::vector<std::string>& enough : {std::vector<std::string>{"1e-9"}, {"0", "1e-9"}}) {
      s.absolute = enough;
      EXPECT_EQ(complaint(s), "");
    }
    s.absolute.clear();
    s.initial = {"0", "1e-200"};
    EXPECT_EQ(complaint(s), "");
  }
}

TEST(Nonsense, AbsoluteTolerances) {
  RunSettings s = settings_of("kepler", "", "1");
  s.integrator = "odeint-dopri5";
  s.tolerance = "1e-6";
  for (const auto& [wrong, said] : {std::pair<std::vector<std::string>, std::string>{
                                        {"1e-9", "1e-9"}, "one for each of the 4 coordinates"},
                                    {{"-1e-9"}, "expected finite numbers >= 0, got -1"},
                                    {{"1e-9", "0", "", "0"}, "expected a finite decimal number"},
                                    {{"nan"}, "expected a finite decimal number"}}) {
    s.absolute = wrong;
    expect_said(complaint(s), {"--absolute: ", said});
  }
  s.absolute = {"1e-9"};
  EXPECT_EQ(complaint(s), "");
  s.tolerance.clear();
  s.step = "0.1";
  expect_said(complaint(s), {"--absolute goes with --tolerance"});
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
  RunSettings many = settings_of("kepler", "1e-9", "1e6");
  many.precision = Precision::quad;  // in double nothing is left of such a step beside the time
  expect_said(complaint(many), {"1e+15 steps", "1000000000000"});
  // Where the method chooses its steps, the run ends.
  s = settings_of("kepler", "", "1000");
  s.integrator = "odeint-dopri5";
  s.tolerance = "1e-10";
  s.step_budget = 500;
  const testing::RecordWithSamples record = executed(s);
  EXPECT_EQ(record.status, Status::not_converged);
  EXPECT_EQ(record.completed, 500);
  expect_said(record.message, {"the budget of 500 steps has run out at t = ", "--max-steps"});
}

// e^{nu t} leaves the range of doubles at t = 473, when the state has long gone to zero.
TEST(Nonsense, AnInvariantThatIsNotFiniteEndsTheRun) {
  const testing::RecordWithSamples record =
      executed(settings_of("damped-oscillator", "0.1", "1e4", {{"nu", "1.5"}}));
  EXPECT_EQ(record.status, Status::non_finite);
  EXPECT_NEAR(static_cast<double>(record.completed), 10 * 709.78 / 1.5, 2);
  expect_said(record.message, {"the invariant birkhoffian is not finite", "at t = 473.",
                               "(step " + std::to_string(record.completed + 1) + ")"});
  for (const Sample<Quad>& sample : record.samples)
    for (const Quad& value : sample.invariants) EXPECT_TRUE(isfinite(value));
  for (const Drift& drift : record.invariants().drift) EXPECT_TRUE(std::isfinite(drift.maximum));
  // Control: the run that ends before.
  const testing::RecordWithSamples shorter =
      executed(settings_of("damped-oscillator", "0.1", "470", {{"nu", "1.5"}}));
  EXPECT_EQ(shorter.status, Status::converged);
  EXPECT_EQ(shorter.completed, 4700);
}

// A parabolic orbit, which the closed form of ellipses does not know. The start itself has no error.
// The closed solution of Kepler's problem is that of ellipses, and gives no numbers for other orbits.
TEST(Nonsense, WhereAClosedSolutionDoesNotHoldASeriesIsTaken) {
  RunSettings s = settings_of("kepler", "0.01", "1", {{"initial", "2,0,0,1"}});
  const testing::RecordWithSamples open = executed(s);
  EXPECT_EQ(open.status, Status::converged);
  EXPECT_EQ(open.reference, "30-digit");
  ASSERT_TRUE(open.error_max.has_value());
  EXPECT_LT(*open.error_max, 1e-4);  // a hundred steps of a method of second order
  s.set = {{"initial", "1,0,0,1"}};
  EXPECT_EQ(executed(s).reference, "exact");
}

TEST(Nonsense, AtRestTheErrorIsZero) {
  const testing::RecordWithSamples record =
      executed(settings_of("harmonic-oscillator", "0.1", "1", {{"initial", "0,0"}}));
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
  const testing::RecordWithSamples record = executed(s);
  EXPECT_EQ(record.status, Status::non_finite);
  expect_said(record.message, {"the drift of x is not finite", "at t = 709."});
  EXPECT_TRUE(std::isfinite(record.invariants().drift[0].maximum));
  s.time = "700";
  EXPECT_EQ(executed(s).status, Status::converged);
}

// Errors whose squares cannot be summed are not left out of the maximum. x is e^t.
TEST(Nonsense, TheMaximumIsThatOfAllErrors) {
  const testing::RecordWithSamples record = executed(settings_of("test-runaway", "0.1", "400"));
  EXPECT_EQ(record.status, Status::converged);
  const double last = static_cast<double>(record.samples.back().invariants[0]);
  EXPECT_GT(last, 1e170);
  EXPECT_EQ(record.invariants().drift[0].maximum, last - 1);
  EXPECT_EQ(record.invariants().drift[0].final_value, last - 1);
  EXPECT_TRUE(std::isinf(record.invariants().drift[0].rms));
  EXPECT_EQ(record.invariants().drift[0].drift_class, DriftClass::exponential);
}

TEST(Nonsense, AStopEndsTheRunAfterItsStep) {
  std::atomic<bool> stop{false};
  RunSettings s = settings_of("kepler", "0.1", "100");
  const ResolvedRun run = resolve(s);
  const testing::RecordWithSamples whole = testing::execute_and_keep(run, nullptr);
  const auto stopping = [&](double fraction) { stop = fraction >= 0.25; };
  const testing::RecordWithSamples record = testing::execute_and_keep(run, nullptr, stopping, &stop);
  EXPECT_TRUE(record.interrupted);
  EXPECT_FALSE(whole.interrupted);
  expect_said(record.message, {"interrupted at t = ", "(step " + std::to_string(record.completed) + ")"});
  EXPECT_GE(record.completed, 250);
  EXPECT_LE(record.completed, 250 + 256);  // steps of a block are taken before any of them is looked at
  ASSERT_EQ(record.samples.size(), static_cast<std::size_t>(record.completed) + 1);
  for (std::size_t k = 0; k < record.samples.size(); ++k)
    EXPECT_EQ(record.samples[k].state, whole.samples[k].state) << k;
  EXPECT_EQ(summary(run, record)["status"], "interrupted");
}

}  // namespace
}  // namespace pfaff
