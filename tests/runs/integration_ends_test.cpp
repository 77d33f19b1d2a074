// What is left of an integration that did not come to its end: the state, its time and what was seen, however
// large the blocks are and whoever watches beside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/integrate.hpp>
#include <pfaff/runs/invariant_errors.hpp>

#include "explosion.hpp"
#include "notes.hpp"

namespace pfaff {
namespace {

using testing::Coordinates;
using testing::Notes;
using testing::state_of;

std::shared_ptr<const MethodInstance> method_of(const std::string& name, const Assignments& set = {}) {
  return integrators().get(name, "integrator").make(set);
}

// The oscillator q' = p, p' = -q, whose field throws once when a limit of q is passed for the first time.
struct Thrower {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -z[0];
    if constexpr (std::is_same_v<T, double>)
      if (armed && z[0] < -0.9) {
        armed = false;
        throw std::runtime_error("beyond the limit");
      }
  }
  static inline bool armed = false;
};
std::shared_ptr<const Model> thrower() {
  return make_model({.name = "thrower",
                     .title = "",
                     .reference = "",
                     .coordinates = {{"q", ""}, {"p", ""}},
                     .initial = {1, 0}},
                    Thrower{});
}

Integration<double> adaptive_thrower(double interval) {
  Start<double> start{thrower(), method_of("odeint-dopri5"), {1, 0}, interval};
  start.tolerance = 1e-12;
  return Integration<double>(std::move(start));
}

// State and time belong together where a step throws that a method has chosen, and the motion goes on right.
TEST(IntegrationEnds, KeepsStateAndTimeTogetherWhereAChosenStepThrows) {
  for (const bool in_intervals : {true, false}) {
    auto run = adaptive_thrower(in_intervals ? 0.1 : 0);
    Thrower::armed = true;
    EXPECT_THROW((void)run.to(4), std::runtime_error);
    // The tolerance is met to three digits of what is left of it after some twenty steps.
    EXPECT_NEAR(run.state()[0], std::cos(run.time()), 1e-9) << in_intervals;
    EXPECT_TRUE(run.to(4).reached());
    EXPECT_NEAR(run.state()[0], std::cos(4), 1e-9) << in_intervals;
  }
}

// What a method remembers of steps that were lost goes with them: it goes on as from a state that is given.
TEST(IntegrationEnds, ForgetsWhereAStepThrows) {
  for (const char* method : {"rk4", "leap-frog"}) {
    const MethodPlugin* plugin = integrators().find(method);
    ASSERT_NE(plugin, nullptr);
    SCOPED_TRACE(method);
    auto run = integrate<double>(thrower(), plugin->make({}), 0.05);
    Notes notes;
    run.watch(notes);
    Thrower::armed = true;
    EXPECT_THROW((void)run.steps(100), std::runtime_error);
    EXPECT_GT(run.steps_taken(), 40);
    EXPECT_EQ(notes.steps.back(), run.steps_taken());
    EXPECT_EQ(notes.states.back(), state_of(run));
    auto fresh = run.at(run.steps_taken(), state_of(run));
    EXPECT_TRUE(run.steps(20).reached());
    EXPECT_TRUE(fresh.steps(20).reached());
    EXPECT_EQ(state_of(run), state_of(fresh));
  }
}

// One watcher ends the run; the others see nothing behind that, whatever the blocks and their order are.
TEST(IntegrationEnds, NobodySeesWhatLiesBehindTheEnd) {
  for (const std::size_t block_rows : {1U, 5U, 16U, 256U})
    for (const bool first : {true, false}) {
      auto run = integrate("kepler", {}, "gauss", {}, {.step = "0.1", .block_rows = block_rows});
      Notes until(37), all, sixes;
      if (first) run.watch(until);
      run.watch(all);
      run.watch(sixes, 6);
      if (!first) run.watch(until);
      EXPECT_EQ(run.steps(1000).end(), Outcome::End::watcher);
      EXPECT_EQ(run.steps_taken(), 37);
      EXPECT_EQ(all.steps.size(), 38U);
      EXPECT_EQ(all.states.back(), state_of(run));
      EXPECT_EQ(sixes.steps.back(), 36);
      EXPECT_EQ(run.steps(4).end(), Outcome::End::reached);
      EXPECT_EQ(all.steps.size(), 42U);
    }
}

// The end that a watcher names comes before a budget, an exception or a failure that lies behind it.
TEST(IntegrationEnds, AWatchersEndComesBeforeWhatLiesBehindIt) {
  for (const std::size_t block_rows : {1U, 16U, 256U}) {
    auto run = integrate("henon-heiles", {}, "gauss", {}, {.step = "0.1", .block_rows = block_rows});
    Notes until(18);
    run.watch(until);
    const Budget budget({.steps = 21});
    EXPECT_EQ(run.steps(100).end(), Outcome::End::watcher);
    EXPECT_EQ(run.steps_taken(), 18);
  }
  for (const std::size_t block_rows : {1U, 256U}) {
    Start<double> start{thrower(), method_of("rk4"), {1, 0}, 0.05};
    start.block_rows = block_rows;
    Integration<double> run(std::move(start));
    Notes until(18);
    run.watch(until);
    Thrower::armed = true;
    EXPECT_EQ(run.steps(100).end(), Outcome::End::watcher);
    Thrower::armed = false;
  }
  for (const std::size_t block_rows : {1U, 256U}) {
    Start<double> start{testing::explosion(), method_of("rk4"), {1}, 0.125};
    start.block_rows = block_rows;
    Integration<double> run(std::move(start));
    Notes until(4);
    run.watch(until);
    EXPECT_EQ(run.steps(100).end(), Outcome::End::watcher);
    EXPECT_EQ(run.steps_taken(), 4);
  }
}

// Numbers of steps may be negative, and multiples of `every` are those of mathematics.
TEST(IntegrationEnds, LooksAtMultiplesFromBeforeTheStart) {
  auto whole = integrate("harmonic-oscillator", {}, "gauss", {}, {.step = "0.1"});
  auto run = whole.at(-5, state_of(whole));
  EXPECT_NEAR(run.time(), -0.5, 1e-15);
  Notes threes;
  run.watch(threes, 3);
  EXPECT_TRUE(run.steps(12).reached());
  EXPECT_EQ(threes.steps, (std::vector<std::int64_t>{-5, -3, 0, 3, 6}));
}

// A watcher of every tenth step sees these alone beside one of all steps.
TEST(IntegrationEnds, WatchersSeeNoStepsOfOthers) {
  const auto largest = [](bool beside) {
    auto run = integrate("kepler", {}, "verlet", {}, {.step = "0.05"});
    InvariantErrors errors;
    Notes notes;
    run.watch(errors, 10);
    if (beside) run.watch(notes);
    EXPECT_TRUE(run.steps(95).reached());
    return errors.largest();
  };
  EXPECT_EQ(largest(true), largest(false));
}

// The last finite state is that of the last step that was one, however seldom somebody looks.
TEST(IntegrationEnds, KeepsTheLastFiniteStateHoweverSeldomSomebodyLooks) {
  auto finely = integrate<double>(testing::explosion(), method_of("rk4"), 0.125);
  EXPECT_EQ(finely.steps(1000).end(), Outcome::End::failed);
  auto seldom = integrate<double>(testing::explosion(), method_of("rk4"), 0.125);
  Notes notes;
  seldom.watch(notes, 50);
  const Outcome outcome = seldom.steps(1000);
  EXPECT_EQ(outcome.status(), Status::non_finite);
  EXPECT_EQ(outcome.steps(), finely.steps_taken());
  EXPECT_EQ(state_of(seldom), state_of(finely));
  EXPECT_EQ(notes.steps.size(), 1U);
}

// Times are those that whole steps reach, of many steps and far from 0 too.
TEST(IntegrationEnds, ReachesTimesOfManyStepsAndFarFromZero) {
  const auto harmonic = integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"});
  // 123456789 steps of .1 end at a time that is rounded; one step more or less would be off by .1.
  auto late = harmonic.at(123456700, state_of(harmonic));
  EXPECT_EQ(late.to(12345678.9).steps(), 89);
  EXPECT_EQ(late.to(12345678.9).steps(), 0);
  EXPECT_EQ(late.to(12345679.0 - 1e-8).steps(), 1);  // what is left is round-off of the time
  auto far = harmonic.beside(state_of(harmonic), 1e6, 0.1);
  EXPECT_EQ(far.to(1e6 + 0.3).steps(), 3);
  EXPECT_EQ(far.to(1e6 + 0.3).steps(), 0);
  EXPECT_EQ(far.to(1e6 + 0.33).steps(), 1);
  EXPECT_THROW((void)far.to(1e6 + 0.3), InputError);
  EXPECT_THROW((void)harmonic.beside(state_of(harmonic), 1e16, 0.1).to(1e16 + 2), InputError);
}

TEST(IntegrationEnds, TakesTheLargestNumberOfStepsUntilItIsTold) {
  auto run = integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"});
  EXPECT_TRUE(run.steps(7).reached());
  const Budget budget({.steps = 100000});
  EXPECT_THROW((void)run.steps(std::numeric_limits<std::int64_t>::max()), BudgetSpent);
  EXPECT_GE(run.steps_taken(), 100000);
}

void expect_refused(Start<double> start, const std::string& words) {
  try {
    const Integration<double> run(std::move(start));
    FAIL() << words;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(words));
  }
}
// Objects have the checks of names.
TEST(IntegrationEnds, RefusesObjectsThatDoNotFit) {
  const auto taylor = [](double tolerance, std::vector<double> absolute) {
    Start<double> start{thrower(), method_of("odeint-dopri5"), {1, 0}, 0.1};
    start.tolerance = tolerance, start.absolute = std::move(absolute);
    return start;
  };
  const double nan = std::nan("");
  expect_refused(taylor(-1e-9, {}), "tolerance: expected a number in (0, 1]");
  expect_refused(taylor(nan, {}), "tolerance: expected a number in (0, 1]");
  expect_refused(taylor(2, {}), "tolerance: expected a number in (0, 1]");
  expect_refused(taylor(0, {1e-9, 1e-9}), "expected a tolerance beside them");
  expect_refused(taylor(1e-9, {1e-9, 0, 0}), "one for each of the 2 coordinates of thrower, got 3");
  expect_refused(taylor(1e-9, {1e-9, -1}), "expected finite numbers >= 0");
  expect_refused({nullptr, method_of("rk4"), {1, 0}, 0.1}, "integration: expected a model");
  expect_refused({thrower(), nullptr, {1, 0}, 0.1}, "integration: expected a method");
  expect_refused({thrower(), method_of("verlet"), {1, 0}, 0.1}, "methods that fit: ");
}
TEST(IntegrationEnds, RefusesCoefficientsInDoubleForAnIntegrationInQuad) {
  for (const MethodPlugin* method : integrators().all()) {
    const auto made = method->make({});
    if (!made->descriptor().double_coefficients || !made->refuses(*thrower()).empty()) continue;
    EXPECT_THROW((void)integrate<Quad>(thrower(), method->make({}), Quad(1) / Quad(10)), InputError)
        << method->name();
    return;
  }
  FAIL() << "no method has coefficients in double";
}

}  // namespace
}  // namespace pfaff
