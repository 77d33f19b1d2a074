// Reversibility along methods: how far they miss the start when they turn round.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

#include "measured_table.hpp"

namespace pfaff {
namespace {

using testing::ToMeasure;

ToMeasure turned(const std::string& system, const std::string& method, const std::string& step = "0.1",
                 const Assignments& set = {}, double time = 20) {
  return testing::to_measure(system, method, step, set, time);
}

struct Return {
  double t, distance, rounding;
};
struct Returns {
  std::vector<Return> looks;
  std::string by;
};
Returns returns_to_start(const ToMeasure& run) {
  Returns returns;
  const MeasuredTable table = table_of("reversibility", run);
  for (const MeasuredTable::Line& line : table.lines) {
    returns.looks.push_back({time_of(line, run), testing::number(line, 0), testing::number(line, 1)});
    returns.by = std::get<std::string>(line.cells[2]);
  }
  return returns;
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
  const Returns coarse = returns_to_start(turned(system, integrator, step, {}, 4));
  const Returns fine = returns_to_start(turned(system, integrator, half, {}, 4));
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
    EXPECT_EQ(returns.by, "reversal") << method;
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
    EXPECT_EQ(returns.by, "negative steps") << method;
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

std::shared_ptr<const Model> model_of(const std::string& name, const std::vector<Real>& initial,
                                      auto system) {
  return make_model(SystemDescriptor{.name = name, .title = "", .reference = "", .initial = initial}, system);
}

template <class S>
Returns returns_of(const S& system, const std::string& method, double t0 = 0) {
  Start<double> start{model_of("stated-pendulum", {Real(1), Real::fraction(1, 2)}, system),
                      integrators().get(method, "integrator").make({}),
                      {1, 0.5},
                      0.1,
                      t0};
  return returns_to_start({Integration<double>(std::move(start)), 200});
}

TEST(Reversibility, TheReversalIsThatOfTheSystem) {
  const Returns right = returns_of(StatedPendulum{}, "gauss");
  EXPECT_EQ(right.by, "reversal");
  EXPECT_LT(farthest(right), 1e-13);

  const Returns wrong = returns_of(StatedPendulum{.stated = Stated::nothing_turned}, "gauss");
  EXPECT_EQ(wrong.by, "reversal");
  EXPECT_GT(farthest(wrong), 0.5);

  const Returns silent = returns_of(SilentPendulum{}, "gauss");
  EXPECT_EQ(silent.by, "negative steps");
  EXPECT_LT(farthest(silent), 1e-13);
  EXPECT_GT(farthest(returns_of(SilentPendulum{}, "rk4")), 1e-6);
}

// The motion of a driven system is another one backwards, whatever reversal it states: the way back begins at
// the time of the turn and goes back to the time of the start.
TEST(Reversibility, SystemsThatDependOnTimeGoBackInTime) {
  const Returns driven = returns_of(StatedPendulum{.drive = Real::fraction(3, 10)}, "gauss", 0.7);
  EXPECT_EQ(driven.by, "negative steps");
  EXPECT_LT(farthest(driven), 1e-12);
}

TEST(Reversibility, MethodsOnConstraintsComeBack) {
  const Returns rattle = returns_to_start(turned("n-pendulum", "rattle", "0.01", {{"bobs", "2"}}, 1));
  EXPECT_EQ(rattle.by, "negative steps");
  EXPECT_LT(farthest(rattle), 1e-13);
  EXPECT_GT(farthest(returns_to_start(turned("n-pendulum", "projected-rk4", "0.01", {{"bobs", "2"}}, 1))),
            1e-11);
  // Dirac's formulation, and constraints of velocities in the nonholonomic one.
  EXPECT_LT(farthest(returns_to_start(turned("n-pendulum", "gauss", "0.01", {{"bobs", "2"}}, 1))), 1e-13);
  const Returns ball = returns_to_start(turned("rolling-ball", "gauss", "0.1", {}, 5));
  EXPECT_EQ(ball.by, "reversal");
  EXPECT_LT(farthest(ball), 1e-13);
}

// GNI carries the reaction of the constraints, of a step's size, which is turned round with the state: that
// of the contact particle by the reversal, which leaves positions where they are; that of the ball, whose
// reversal is a mirror, by negative steps, which is what the method claims there.
TEST(Reversibility, WhatIsRememberedIsTurnedRoundToo) {
  for (const char* method : {"gni", "nonholonomic-leap-frog"}) {
    const Returns particle = returns_to_start(turned("contact-particle", method));
    EXPECT_EQ(particle.by, "reversal") << method;
    EXPECT_LT(farthest(particle), 1e-13) << method;
    for (const Return& one : particle.looks) EXPECT_TRUE(std::isnan(one.rounding)) << method;
  }
  const Returns ball = returns_to_start(turned("rolling-ball", "gni", "0.1", {}, 5));
  EXPECT_EQ(ball.by, "negative steps");
  EXPECT_LT(farthest(ball), 1e-13);
}

// Methods of 2, 8 and 12 states; the first steps of the latter are those of Gauss collocation.
TEST(Reversibility, MultistepMethodsAreLeftOut) {
  const std::string tables = std::string(PFAFF_GOLDEN) + "/../../examples/tables/quinlan-tremaine-";
  EXPECT_TRUE(returns_to_start(turned("kepler", "leap-frog", "0.05")).looks.empty());
  EXPECT_TRUE(returns_to_start(turned("kepler", tables + "8.toml", "0.05")).looks.empty());
  EXPECT_TRUE(returns_to_start(turned("kepler", tables + "12.toml", "0.05")).looks.empty());
}

// The midpoint rule turns the plane of the oscillator, and keeps every distance in it, so that what is 2^-53
// of one state is 2^-53 of the other. Beside the upright position of a pendulum distances grow as e^t.
TEST(Reversibility, ARoundingGrowsAsTheMotionMakesIt) {
  const Returns round =
      returns_to_start(turned("harmonic-oscillator", "implicit-midpoint", "0.1", {{"initial", "3,4"}}));
  for (const Return& one : round.looks) EXPECT_NEAR(one.rounding / 0x1p-53, 1, 1e-6) << one.t;
  const Returns upright =
      returns_to_start(turned("pendulum", "gauss", "0.05", {{"initial", "3.141592653589793,1e-9"}}, 10));
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

TEST(Reversibility, AFirstStepThatCannotBeTakenBackEndsTheTable) {
  static const Method<OnlyForward> only_forward{
      {.name = "only-forward", .title = "", .reference = "", .order = 1}};
  for (const bool forward : {false, true}) {
    Start<double> start{
        model_of("bounded", {1, 1}, Bounded{}), integrators().get("rk4", "integrator").make({}), {1, 1}, 1};
    if (forward) start.method = only_forward.make({});
    const MeasuredTable table = table_of("reversibility", {Integration<double>(std::move(start)), 4});
    EXPECT_TRUE(table.lines.empty()) << forward;
    EXPECT_EQ(table.ended, "the first step cannot be taken back: the step back does not converge");
  }
}

TEST(Reversibility, TurnsAreSpacedEvenlyInTheirLogarithm) {
  const auto steps_of = [](const ToMeasure& run) {
    std::vector<long long> steps;
    for (const Return& one : returns_to_start(run).looks) steps.push_back(std::llround(one.t / 0.1));
    return steps;
  };
  EXPECT_EQ(steps_of(turned("pendulum", "verlet", "0.1", {}, 200)),
            (std::vector<long long>{1, 2, 3, 6, 10, 18, 32, 56, 100, 178, 316, 562, 1000}));
  EXPECT_EQ(steps_of(turned("pendulum", "verlet", "0.1", {}, 0.4)), (std::vector<long long>{1, 2, 3, 4}));
  // Of 256 coordinates a quarter of the steps.
  EXPECT_EQ(steps_of(turned("fermi-pasta-ulam-tsingou", "verlet", "0.1", {{"n", "128"}}, 200)).back(), 250);
}

}  // namespace
}  // namespace pfaff
