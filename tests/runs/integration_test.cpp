// An integration as an object: the states, times and ends of its calls, whoever watches and however long the
// calls are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/integrate.hpp>

#include "../integrators/methods.hpp"
#include "explosion.hpp"
#include "notes.hpp"

namespace pfaff {
namespace {

using testing::Coordinates;
using ::testing::HasSubstr;
using testing::Notes;
using testing::state_of;

// The state after so many steps by a single call of a stepper.
template <class T>
std::vector<T> by_stepper(const std::string& system, const std::string& method, const Assignments& set,
                          const T& h, std::int64_t steps) {
  return testing::after_steps(*testing::method_named(method, set), testing::model_named(system), h, steps);
}

TEST(Integration, TakesTheStepsOfAStepper) {
  auto run = integrate("kepler", {}, "gauss", {{"stages", "3"}}, {.step = "0.05"});
  EXPECT_TRUE(run.steps(7).reached());
  EXPECT_EQ(run.steps(600).steps(), 600);
  EXPECT_TRUE(run.steps(0).reached());
  EXPECT_EQ(state_of(run), by_stepper<double>("kepler", "gauss", {{"stages", "3"}}, 0.05, 607));
  EXPECT_EQ(run.steps_taken(), 607);
  EXPECT_EQ(run.time(), 607 * 0.05);
  EXPECT_EQ(run.counters().steps, 607);

  auto in_quad = integrate<Quad>("kepler", {}, "verlet", {}, {.step = "0.1"});
  EXPECT_TRUE(in_quad.steps(20).reached());
  const Quad tenth = Real::fraction(1, 10).quad();
  EXPECT_EQ((std::vector<Quad>{in_quad.state().begin(), in_quad.state().end()}),
            by_stepper<Quad>("kepler", "verlet", {}, tenth, 20));
  EXPECT_EQ(in_quad.time(), Quad(20) * tenth);
}

TEST(Integration, OfObjectsIsThatOfNames) {
  const auto model = testing::model_named("kepler");
  auto of_objects = integrate(model, integrators().get("verlet", "integrator").make({}), 0.1);
  auto of_names = integrate("Kepler", {}, "VERLET", {}, {.step = "0.1"});
  EXPECT_TRUE(of_objects.steps(50).reached());
  EXPECT_TRUE(of_names.steps(50).reached());
  EXPECT_EQ(state_of(of_objects), state_of(of_names));
}

// A system with constraints is moved by its formulation where the method needs a field, and as it is where
// the method steps on the constraints.
TEST(Integration, TakesTheMotionOfConstraints) {
  const auto with_field = integrate("spherical-pendulum", {}, "rk4", {}, {.step = "0.01"});
  EXPECT_TRUE(with_field.model()->moves());
  const auto on_constraints = integrate("spherical-pendulum", {}, "rattle", {}, {.step = "0.01"});
  EXPECT_FALSE(on_constraints.model()->moves());
}

// Whoever watches sees every so many steps, however calls and blocks are cut, and changes no bit.
TEST(Integration, WatchersSeeTheirStepsWhateverTheCalls) {
  for (const std::size_t block_rows : {1U, 7U, 16U, 256U})
    for (const std::vector<std::int64_t>& calls :
         {std::vector<std::int64_t>{120}, {1, 1, 1, 117}, {59, 61}, {13, 30, 0, 77}}) {
      auto run = integrate("henon-heiles", {}, "gauss", {}, {.step = "0.1", .block_rows = block_rows});
      Notes threes, fives;
      run.watch(threes, 3);
      run.watch(fives, 5);
      for (const std::int64_t count : calls) EXPECT_TRUE(run.steps(count).reached());
      ASSERT_EQ(threes.steps.size(), 41U);
      ASSERT_EQ(fives.steps.size(), 25U);
      for (std::size_t k = 0; k < 41; ++k) EXPECT_EQ(threes.steps[k], static_cast<std::int64_t>(3 * k));
      for (std::size_t k = 0; k < 25; ++k) {
        EXPECT_EQ(fives.steps[k], static_cast<std::int64_t>(5 * k));
        EXPECT_EQ(fives.times[k], static_cast<double>(5 * k) * 0.1);
        EXPECT_EQ(fives.states[k], by_stepper<double>("henon-heiles", "gauss", {}, 0.1, fives.steps[k]));
      }
      EXPECT_EQ(state_of(run), by_stepper<double>("henon-heiles", "gauss", {}, 0.1, 120));
    }
}

// A fall into the centre, which no step of an explicit method passes: it takes pi/(2 sqrt 2) of time.
TEST(Integration, OfChosenStepsSaysThatTheControlGaveUp) {
  auto run = integrate("kepler", {}, "taylor", {},
                       {.step = "10", .initial = {"1", "0", "0", "0"}, .tolerance = "1e-9"});
  const Outcome outcome = run.steps(1);
  EXPECT_EQ(outcome.status(), Status::not_converged);
  EXPECT_EQ(outcome.steps(), 0);
  EXPECT_EQ(outcome.message(), "the step control gave up at t = 1.110720735 (step " +
                                   std::to_string(run.counters().steps) + "): no step meets the tolerance");
  EXPECT_GT(run.counters().steps, 100);
}

TEST(Integration, EndsAtTheRowThatAWatcherNames) {
  auto run = integrate("kepler", {}, "gauss", {}, {.step = "0.1"});
  Notes until(37);
  run.watch(until);
  const Outcome outcome = run.steps(1000);
  EXPECT_EQ(outcome.end(), Outcome::End::watcher);
  EXPECT_EQ(outcome.steps(), 37);
  EXPECT_EQ(run.steps_taken(), 37);
  EXPECT_EQ(run.time(), 37 * 0.1);
  EXPECT_EQ(state_of(run), until.states.back());
  EXPECT_THAT(outcome.message(), HasSubstr("(step 37)"));
  EXPECT_THROW(outcome.expect_reached(), RunError);
  // From there it goes on as from a state that is given.
  auto other = run.at(37, state_of(run));
  EXPECT_TRUE(run.steps(20).reached());
  EXPECT_TRUE(other.steps(20).reached());
  EXPECT_EQ(state_of(run), state_of(other));
  EXPECT_EQ(run.time(), other.time());
}

// Symmetric methods come back to where they began; a method that is not does not. What is left is rounding:
// 400 steps of errors of a few units of 1.1e-16, which the motion hardly amplifies.
TEST(Integration, TurnsRound) {
  const auto back = [](const std::string& method, const Assignments& set) {
    auto run = integrate("pendulum", {}, method, set, {.step = "0.05"});
    const Coordinates begin = state_of(run);
    EXPECT_TRUE(run.steps(200).reached());
    run.turn();
    EXPECT_EQ(run.step(), -0.05);
    EXPECT_TRUE(run.steps(200).reached());
    EXPECT_NEAR(run.time(), 0, 1e-14);
    double distance = 0;
    for (std::size_t i = 0; i < begin.size(); ++i)
      distance = std::max(distance, std::abs(run.state()[i] - begin[i]));
    return distance;
  };
  EXPECT_LT(back("verlet", {}), 1e-12);
  EXPECT_LT(back("gauss", {{"stages", "2"}}), 1e-12);
  EXPECT_GT(back("rk4", {}), 1e-9);
}

// A leap-frog leaps from the state before the last; where that is forgotten, it steps as one that begins
// there.
TEST(Integration, ForgetsWhatTheMethodRemembers) {
  const auto third = [](bool forgets) {
    auto run = integrate("kepler", {}, "leap-frog", {}, {.step = "0.1"});
    run.steps(2).expect_reached();
    auto fresh = run.beside({run.state().begin(), run.state().end()});
    if (forgets) run.forget();
    run.steps(1).expect_reached();
    fresh.steps(1).expect_reached();
    return std::abs(run.state()[0] - fresh.state()[0]);
  };
  EXPECT_EQ(third(true), 0);
  EXPECT_GT(third(false), 1e-6);  // control
}

// Negative steps, by names: the harmonic motion backwards is that of -p. The error is the method's, h^8.
TEST(Integration, GoesBackwardsInTime) {
  auto back = integrate("harmonic-oscillator", {}, "gauss", {{"stages", "4"}},
                        {.step = "-0.1", .initial = {"0.3", "0.4"}});
  EXPECT_TRUE(back.to(-2).reached());
  EXPECT_EQ(back.steps_taken(), 20);
  EXPECT_NEAR(back.time(), -2, 1e-15);
  EXPECT_NEAR(back.state()[0], 0.3 * std::cos(2) - 0.4 * std::sin(2), 1e-10);
  EXPECT_NEAR(back.state()[1], 0.4 * std::cos(2) + 0.3 * std::sin(2), 1e-10);
  auto forth = back.reversed();
  EXPECT_EQ(forth.step(), 0.1);
  EXPECT_TRUE(forth.to(0).reached());
  EXPECT_NEAR(forth.state()[0], 0.3, 1e-13);
  EXPECT_NEAR(forth.state()[1], 0.4, 1e-13);

  auto adaptive = integrate("harmonic-oscillator", {}, "taylor", {},
                            {.step = "-0.3", .initial = {"0.3", "0.4"}, .tolerance = "1e-14"});
  EXPECT_TRUE(adaptive.to(-2).reached());
  EXPECT_EQ(adaptive.time(), -2);
  EXPECT_NEAR(adaptive.state()[0], 0.3 * std::cos(2) - 0.4 * std::sin(2), 1e-12);
}

TEST(Integration, GoesToATime) {
  auto run = integrate("harmonic-oscillator", {}, "verlet", {}, {.step = "0.1"});
  EXPECT_EQ(run.to(0.3).steps(), 3);  // to a billionth of a step, though 3 times 0.1 is beyond it
  EXPECT_EQ(run.to(0.3).steps(), 0);
  EXPECT_EQ(run.to(0.55).steps(), 3);
  EXPECT_EQ(run.to(0.55).steps(), 0);
  EXPECT_EQ(run.time(), 6 * 0.1);
  try {
    (void)run.to(0.1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("lies behind t = 0.6"));
  }
}

// A method that chooses its steps is looked at in equal intervals and ends where it is told to.
TEST(Integration, ChoosesItsSteps) {
  auto run = integrate("harmonic-oscillator", {}, "taylor", {},
                       {.step = "0.5", .initial = {"1", "0"}, .tolerance = "1e-14"});
  Notes notes;
  run.watch(notes);
  EXPECT_TRUE(run.to(1.75).reached());
  EXPECT_EQ(notes.times, (Coordinates{0, 0.5, 1, 1.5}));
  for (std::size_t k = 0; k < notes.times.size(); ++k)
    EXPECT_NEAR(notes.states[k][0], std::cos(notes.times[k]), 1e-13);
  EXPECT_EQ(run.time(), 1.75);
  EXPECT_NEAR(run.state()[0], std::cos(1.75), 1e-13);
  EXPECT_TRUE(run.steps(1).reached());
  EXPECT_EQ(notes.times.back(), 2);
  EXPECT_EQ(run.to(2.5 - 1e-12).steps(), 1);  // the end of an interval, from which it does not step back
  EXPECT_EQ(run.time(), 2.5);
  EXPECT_EQ(notes.times.back(), 2.5);
  EXPECT_EQ(run.to(2.5 + 1e-12).steps(), 0);
  EXPECT_THROW((void)run.to(std::nan("")), InputError);

  auto unwatched = integrate("harmonic-oscillator", {}, "taylor", {},
                             {.step = "0", .initial = {"1", "0"}, .tolerance = "1e-14"});
  EXPECT_TRUE(unwatched.to(7).reached());
  EXPECT_NEAR(unwatched.state()[0], std::cos(7), 1e-12);
  EXPECT_THROW((void)unwatched.steps(1), InputError);
  EXPECT_THROW(unwatched.watch(notes), InputError);
}

// Sets a flag once it has seen a step.
class Asks final : public Watcher<double> {
 public:
  Asks(std::atomic<bool>& flag, std::int64_t step) : flag_(flag), step_(step) {}
  void start(const Integration<double>& /*run*/) override {}
  void look(const Integration<double>& /*run*/, const Block<double>& block) override {
    if (block.step(block.rows - 1) >= step_) flag_ = true;
  }

 private:
  std::atomic<bool>& flag_;
  std::int64_t step_;
};

TEST(Integration, EndsWhereItIsAskedTo) {
  std::atomic<bool> flag = false;
  auto run = integrate("henon-heiles", {}, "gauss", {}, {.step = "0.1", .block_rows = 4});
  Asks asks(flag, 10);
  run.watch(asks);
  run.stop_when(flag);
  const Outcome outcome = run.steps(1000000);
  EXPECT_EQ(outcome.end(), Outcome::End::asked);
  EXPECT_EQ(outcome.steps(), 12);
  EXPECT_THAT(outcome.message(), HasSubstr("interrupted at t = 1.2 (step 12)"));
  EXPECT_EQ(state_of(run), by_stepper<double>("henon-heiles", "gauss", {}, 0.1, 12));
  flag = false;
  EXPECT_EQ(run.steps(2).end(), Outcome::End::reached);  // `asks` sets the flag behind the last step
}

// A budget around the call passes on; state and time belong together, and what was seen is not lost.
TEST(Integration, KeepsWhatABudgetLeaves) {
  auto run = integrate("henon-heiles", {}, "gauss", {}, {.step = "0.1", .block_rows = 8});
  Notes notes;
  run.watch(notes);
  {
    const Budget budget({.steps = 21});
    EXPECT_THROW((void)run.steps(100), BudgetSpent);
  }
  EXPECT_EQ(run.steps_taken(), 21);
  EXPECT_EQ(notes.steps.back(), 21);
  EXPECT_TRUE(run.steps(79).reached());
  EXPECT_EQ(notes.steps.size(), 101U);
  EXPECT_EQ(state_of(run), by_stepper<double>("henon-heiles", "gauss", {}, 0.1, 100));
}

TEST(Integration, KeepsTheLastFiniteState) {
  const auto model = testing::explosion();
  const std::shared_ptr<const MethodInstance> rk4 = integrators().get("rk4", "integrator").make({});
  auto run = integrate(model, rk4, 0.125);
  const Outcome outcome = run.steps(1000);
  EXPECT_EQ(outcome.end(), Outcome::End::failed);
  EXPECT_EQ(outcome.status(), Status::non_finite);
  EXPECT_TRUE(std::isfinite(run.state()[0]));
  EXPECT_GT(run.state()[0], 1e3);
  EXPECT_EQ(outcome.steps(), run.steps_taken());
  EXPECT_THAT(outcome.message(), HasSubstr("left the range of numbers at t = "));
  // The next step is the one that fails.
  EXPECT_EQ(run.beside(state_of(run)).steps(1).status(), Status::non_finite);
}

// Cannot begin, and counts what it is shown all the same.
class Unable final : public Watcher<double> {
 public:
  void start(const Integration<double>& /*run*/) override { throw InputError("unable"); }
  void look(const Integration<double>& /*run*/, const Block<double>& /*block*/) override { looks += 1; }
  int looks = 0;
};
TEST(Integration, AWatcherThatCannotBeginDoesNotWatch) {
  auto run = integrate("kepler", {}, "verlet", {}, {.step = "0.1"});
  Unable unable;
  EXPECT_THROW(run.watch(unable), InputError);
  EXPECT_TRUE(run.steps(10).reached());
  EXPECT_EQ(unable.looks, 0);
}

void expect_refused(const std::function<void()>& work, const std::string& words) {
  try {
    work();
    FAIL() << words;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}
TEST(Integration, RefusesWhatDoesNotFit) {
  const auto kepler = [](const AskedIntegration& asked, const char* method = "verlet") {
    return [=] { (void)integrate("kepler", {}, method, {}, asked); };
  };
  expect_refused(kepler({.step = "0"}), "step: expected a finite number other than 0");
  expect_refused(kepler({.step = "fast"}), "step: expected a finite decimal number or a/b, got 'fast'");
  expect_refused(kepler({.step = "0.1", .initial = {"1", "2"}}), "kepler: expected 4 numbers, got 2");
  expect_refused(kepler({.step = "0.1", .t0 = "nan"}), "initial time");
  expect_refused(kepler({.step = "0.1", .tolerance = "1e-9"}), "verlet takes fixed steps only");
  expect_refused(kepler({.step = "0.1", .tolerance = "0"}, "taylor"),
                 "tolerance: expected a number in (0, 1]");
  expect_refused(kepler({.step = "0.1", .formulation = "dirac"}), "kepler has no constraints");
  expect_refused(kepler({.step = "0.1"}, "verlot"), "did you mean 'verlet'");
  expect_refused([] { (void)integrate("damped-oscillator", {}, "verlet", {}, {.step = "0.1"}); }, "verlet");
  expect_refused(kepler({.step = "0.1", .tolerance = "1e-9", .absolute = {"1", "2"}}, "taylor"),
                 "one for each of the 4 coordinates");
  expect_refused(kepler({.step = "0.1", .initial = {"0", "0", "1", "0"}}),
                 "kepler: the vector field is not finite there");
  const auto pendulum = [](const char* method, const std::vector<std::string>& initial) {
    return [=] {
      (void)integrate("n-pendulum", {{"bobs", "1"}}, method, {}, {.step = "0.1", .initial = initial});
    };
  };
  expect_refused(pendulum("rattle", {"0.8", "0.8", "0", "0"}), "; expected a state on the constraints");
  pendulum("rattle", {"0.6", "0.8", "0", "0"})();
  expect_refused([] { (void)integrate<Quad>("kepler", {}, "odeint-rk4", {}, {.step = "0.1"}); },
                 "coefficients in double only");
  auto run = integrate("kepler", {}, "verlet", {}, {.step = "0.1"});
  expect_refused([&] { (void)run.steps(-1); }, "turn() and reversed() go back");
  Notes notes;
  expect_refused([&] { run.watch(notes, 0); }, "expected a whole number > 0");
}

TEST(Integration, OfNothingIsRefused) {
  const std::shared_ptr<const MethodInstance> method = integrators().get("verlet", "integrator").make({});
  EXPECT_THROW((void)integrate(std::shared_ptr<const Model>(), method, 0.1), InputError);
  EXPECT_THROW(
      (void)integrate("kepler", {}, "verlet", {}, {.step = "0.1", .block_rows = std::size_t{1} << 62}),
      InputError);
}

}  // namespace
}  // namespace pfaff
