// Reversibility along methods: how far they miss the start when they turn round.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <pfaff/bench/experiment/reversibility.hpp>
#include <pfaff/bench/runner/files.hpp>

#include "../temporary_directory.hpp"
#include "run_settings.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::settings_of;

ResolvedRun turned(const std::string& system, const std::string& integrator, const std::string& step = "0.1",
                   const Assignments& set = {}, const std::string& time = "20") {
  RunSettings settings = settings_of(system, step, time, set);
  settings.integrator = integrator;
  return resolve(settings);
}

double farthest(const Returns& returns) {
  EXPECT_FALSE(returns.looks.empty());
  double worst = 0;
  for (const Return& one : returns.looks)
    worst = std::isnan(one.distance) ? one.distance : std::max(worst, one.distance);
  return worst;
}

// The power of h with which the distance at the end falls.
double power(const std::string& system, const std::string& integrator, const std::string& step,
             const std::string& half) {
  const Returns coarse = returns_to_start(turned(system, integrator, step, {}, "4"));
  const Returns fine = returns_to_start(turned(system, integrator, half, {}, "4"));
  EXPECT_NEAR(coarse.looks.back().t, 4, 1e-12);
  EXPECT_NEAR(fine.looks.back().t, 4, 1e-12);
  return std::log2(coarse.looks.back().distance / fine.looks.back().distance);
}

// Rounding errors of up to 400 steps, which three times round an ellipse the shear of Kepler's problem makes
// a hundred times as large: a few 1e-13. RK4 misses the start by h^6 a step, h^5 over a time that is given,
// because the part h^5 of its error changes its sign with h and is undone.
TEST(Reversibility, SymmetricMethodsComeBackByTheReversal) {
  for (const char* method : {"verlet", "gauss", "implicit-midpoint", "generating-function"}) {
    const Returns returns = returns_to_start(turned("kepler", method, "0.05"));
    EXPECT_EQ(returns.by, WayBack::reversal) << method;
    EXPECT_LT(farthest(returns), 2e-12) << method;
  }
  EXPECT_GT(farthest(returns_to_start(turned("kepler", "rk4", "0.05"))), 1e-3);
  EXPECT_GT(farthest(returns_to_start(turned("kepler", "symplectic-euler", "0.05"))), 0.1);
  EXPECT_NEAR(power("pendulum", "rk4", "0.1", "0.05"), 5, 0.3);
  EXPECT_NEAR(power("pendulum", "symplectic-euler", "0.01", "0.005"), 1, 0.1);
}

TEST(Reversibility, DampedSystemsGoBackByNegativeSteps) {
  for (const char* method : {"generating-function", "gauss-darboux", "gauss"}) {
    const Returns returns = returns_to_start(turned("damped-pendulum", method));
    EXPECT_EQ(returns.by, WayBack::negative_steps) << method;
    EXPECT_LT(farthest(returns), 1e-13) << method;
  }
  EXPECT_GT(farthest(returns_to_start(turned("damped-pendulum", "rk4"))), 1e-6);
  EXPECT_NEAR(power("damped-pendulum", "rk4", "0.1", "0.05"), 5, 0.3);
}

// A pendulum that is driven by `drive` and states a reversal, the right one or another.
enum class Stated { momentum, nothing_turned };
struct StatedPendulum {
  static constexpr int dimension = 2;
  Stated stated = Stated::momentum;
  Real drive{0};
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = drive * cos(t) - sin(z[0]);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reversed[0] = z[0];
    reversed[1] = stated == Stated::momentum ? T(-z[1]) : T(z[1]);
  }
};
// The same without one.
struct SilentPendulum {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -sin(z[0]);
  }
};

template <class S>
Returns returns_of(const S& system, const std::string& integrator, const std::string& t0 = "0") {
  RunSettings settings = settings_of("pendulum", "0.1", "20");
  settings.integrator = integrator;
  settings.t0 = t0;
  ResolvedRun run = resolve(settings);
  run.initial = {Real(1), Real::fraction(1, 2)};
  run.model = make_model(
      SystemDescriptor{.name = "stated-pendulum", .title = "", .reference = "", .initial = run.initial},
      system);
  return returns_to_start(run);
}

TEST(Reversibility, TheReversalIsThatOfTheSystem) {
  const Returns right = returns_of(StatedPendulum{}, "gauss");
  EXPECT_EQ(right.by, WayBack::reversal);
  EXPECT_LT(farthest(right), 1e-13);

  const Returns wrong = returns_of(StatedPendulum{.stated = Stated::nothing_turned}, "gauss");
  EXPECT_EQ(wrong.by, WayBack::reversal);
  EXPECT_GT(farthest(wrong), 0.5);

  const Returns silent = returns_of(SilentPendulum{}, "gauss");
  EXPECT_EQ(silent.by, WayBack::negative_steps);
  EXPECT_LT(farthest(silent), 1e-13);
  EXPECT_GT(farthest(returns_of(SilentPendulum{}, "rk4")), 1e-6);
}

// The motion of a driven system is another one backwards, whatever reversal it states: the way back begins at
// the time of the turn and goes back to the time of the start.
TEST(Reversibility, SystemsThatDependOnTimeGoBackInTime) {
  const Returns driven = returns_of(StatedPendulum{.drive = Real::fraction(3, 10)}, "gauss", "0.7");
  EXPECT_EQ(driven.by, WayBack::negative_steps);
  EXPECT_LT(farthest(driven), 1e-12);
}

TEST(Reversibility, MethodsOnConstraintsComeBack) {
  const Returns rattle = returns_to_start(turned("n-pendulum", "rattle", "0.01", {{"bobs", "2"}}, "1"));
  EXPECT_EQ(rattle.by, WayBack::negative_steps);
  EXPECT_LT(farthest(rattle), 1e-13);
  EXPECT_GT(farthest(returns_to_start(turned("n-pendulum", "projected-rk4", "0.01", {{"bobs", "2"}}, "1"))),
            1e-11);
  // Dirac's formulation, and constraints of velocities in the nonholonomic one.
  EXPECT_LT(farthest(returns_to_start(turned("n-pendulum", "gauss", "0.01", {{"bobs", "2"}}, "1"))), 1e-13);
  const Returns ball = returns_to_start(turned("rolling-ball", "gauss", "0.1", {}, "5"));
  EXPECT_EQ(ball.by, WayBack::reversal);
  EXPECT_LT(farthest(ball), 1e-13);
}

// GNI carries the reaction of the constraints, of a step's size, which is turned round with the state: that
// of the contact particle by the reversal, which leaves positions where they are; that of the ball, whose
// reversal is a mirror, by negative steps, which is what the method claims there.
TEST(Reversibility, WhatIsRememberedIsTurnedRoundToo) {
  for (const char* method : {"gni", "nonholonomic-leap-frog"}) {
    const Returns particle = returns_to_start(turned("contact-particle", method));
    EXPECT_EQ(particle.by, WayBack::reversal) << method;
    EXPECT_LT(farthest(particle), 1e-13) << method;
    for (const Return& one : particle.looks) EXPECT_TRUE(std::isnan(one.rounding)) << method;
  }
  const Returns ball = returns_to_start(turned("rolling-ball", "gni", "0.1", {}, "5"));
  EXPECT_EQ(ball.by, WayBack::negative_steps);
  EXPECT_LT(farthest(ball), 1e-13);
}

// Methods of 2, 8 and 12 states; the first steps of the latter are those of Gauss collocation.
TEST(Reversibility, MultistepMethodsAreLeftOut) {
  const std::string tables = std::string(PFAFF_GOLDEN) + "/../../examples/tables/quinlan-tremaine-";
  EXPECT_TRUE(returns_to_start(turned("kepler", "leap-frog", "0.05")).looks.empty());
  EXPECT_TRUE(returns_to_start(turned("kepler", tables + "8.toml", "0.05")).looks.empty());
  EXPECT_TRUE(returns_to_start(turned("kepler", tables + "12.toml", "0.05")).looks.empty());
}

// What a run measures of the structure of a step would be that of the method of its first steps.
TEST(Reversibility, RunsOfMultistepMethodsHaveNoStructureOfAStep) {
  const std::string table = std::string(PFAFF_GOLDEN) + "/../../examples/tables/quinlan-tremaine-12.toml";
  EXPECT_FALSE(execute(turned("kepler", table, "0.05"), nullptr).structure_residual);
  EXPECT_TRUE(execute(turned("kepler", "gauss", "0.05"), nullptr).structure_residual);
}

// The midpoint rule turns the plane of the oscillator, and keeps every distance in it, so that what is 2^-53
// of one state is 2^-53 of the other. Beside the upright position of a pendulum distances grow as e^t.
TEST(Reversibility, ARoundingGrowsAsTheMotionMakesIt) {
  const Returns round =
      returns_to_start(turned("harmonic-oscillator", "implicit-midpoint", "0.1", {{"initial", "3,4"}}));
  for (const Return& one : round.looks) EXPECT_NEAR(one.rounding / 0x1p-53, 1, 1e-6) << one.t;
  const Returns upright =
      returns_to_start(turned("pendulum", "gauss", "0.05", {{"initial", "3.141592653589793,1e-9"}}, "10"));
  const Return& last = upright.looks.back();
  ASSERT_NEAR(last.t, 10, 1e-12);
  EXPECT_NEAR(std::log(last.rounding / 0x1p-53), 10, 1);
  EXPECT_LT(last.distance, 1000 * last.rounding);
}

// x' = -sqrt(1.001 - x): steps of RK4 back from where long ones have led take the root of a negative number.
struct Bounded {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = -sqrt(Real::fraction(1001, 1000) - z[0]);
    rate[1] = z[1] - z[1];
  }
};

// Euler's method, which leaves the state where it is and says so where it is to go back.
struct OnlyForward {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork& /*w*/) const {
    if (value_of(h) < 0) return Status::not_converged;
    State<P> rate = p.make_state();
    p.field(t, z, rate);
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = z[i] + h * rate[i];
    return Status::converged;
  }
};

TEST(Reversibility, AWayBackThatFailsHasNoDistance) {
  static const Method<OnlyForward> only_forward{
      {.name = "only-forward", .title = "", .reference = "", .order = 1}};
  ResolvedRun run = resolve(settings_of("pendulum", "1", "4"));
  run.initial = {1, 1};
  run.model = make_model(
      SystemDescriptor{.name = "bounded", .title = "", .reference = "", .initial = run.initial}, Bounded{});
  for (const bool forward : {false, true}) {
    if (forward) run.method = only_forward.make({});
    const Returns returns = returns_to_start(run);
    ASSERT_EQ(returns.looks.size(), 4U);
    for (const Return& one : returns.looks) {
      EXPECT_TRUE(std::isnan(one.distance)) << one.t;
      EXPECT_TRUE(std::isnan(one.rounding)) << one.t;
    }
  }
}

TEST(Reversibility, TurnsAreSpacedEvenlyInTheirLogarithm) {
  const auto steps_of = [](const ResolvedRun& run) {
    std::vector<long long> steps;
    for (const Return& one : returns_to_start(run).looks) steps.push_back(std::llround(one.t / 0.1));
    return steps;
  };
  EXPECT_EQ(steps_of(turned("pendulum", "verlet", "0.1", {}, "200")),
            (std::vector<long long>{1, 2, 3, 6, 10, 18, 32, 56, 100, 178, 316, 562, 1000}));
  EXPECT_EQ(steps_of(turned("pendulum", "verlet", "0.1", {}, "0.4")), (std::vector<long long>{1, 2, 3, 4}));
  // Of 256 coordinates a quarter of the steps.
  EXPECT_EQ(steps_of(turned("fermi-pasta-ulam-tsingou", "verlet", "0.1", {{"n", "128"}}, "200")).back(), 250);
}

TEST(Reversibility, IsThatOfTheLargestStepThatEndsWell) {
  const pfaff::testing::TemporaryDirectory files;
  write_file(files / "test.toml", R"(schema = 1
title = "A test"
[[method]]
label = "RK4, one"
integrator = "rk4"
[[method]]
label = "chosen"
integrator = "odeint-dopri5"
tolerance = ["1e-6"]
[[method]]
label = "two states"
integrator = "leap-frog"
[[case]]
name = "swing"
system = "pendulum"
methods = ["RK4, one", "chosen", "two states"]
time = 4
steps = [0.1, 0.4, 0.2]
[[case]]
name = "many"
system = "quartic-nonholonomic"
methods = ["RK4, one"]
time = 4
steps = [0.1]
seeds = 2
[[method]]
label = "remembers"
integrator = "gni"
[[case]]
name = "particle"
system = "contact-particle"
methods = ["remembers"]
time = 0.1
steps = [0.1]
)");
  const Experiment of = read_experiment(files / "test.toml", false);
  const auto runs = expand(of);
  std::vector<nlohmann::json> summaries(runs.size(), {{"status", "converged"}});
  const auto rows_with = [&](const std::string& begin) {
    std::istringstream lines(reversibility_csv(runs, summaries));
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with(begin) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(rows_with("case,method,step,t,distance,rounding,by"), 1U);
  const std::size_t turns = 9;  // after 1 to 8 and 10 steps, as 10^(k/12) is rounded
  EXPECT_EQ(rows_with("swing,\"RK4, one\",0.4,"), turns);
  EXPECT_EQ(rows_with(""), 1 + turns + 1);
  EXPECT_TRUE(reversibility_csv(runs, summaries).ends_with(",,reversal\n"));  // no rounding of GNI
  for (std::size_t k = 0; k < runs.size(); ++k)
    if (runs[k].step == "0.4") summaries[k]["status"] = "non_finite";
  EXPECT_EQ(rows_with("swing,\"RK4, one\",0.2,"), rows_with("") - 2);
  for (nlohmann::json& summary : summaries) summary["status"] = "non_finite";
  EXPECT_EQ(reversibility_csv(runs, summaries), "");
}

}  // namespace
