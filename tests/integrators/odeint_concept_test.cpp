// Methods of this library as steppers in Boost.Odeint's integration routines.
#include <gtest/gtest.h>

#include <boost/numeric/odeint/integrate/integrate_const.hpp>
#include <cmath>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/odeint/stepper.hpp>
#include <pfaff/integrators/multistep/leap_frog.hpp>

namespace pfaff {
namespace {

// The implicit midpoint rule written as a researcher would, by fixed-point iteration.
struct Midpoint {
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, NoWork&) const {
    State<P> middle = z, rate = z;
    for (int iteration = 0; iteration < 60; ++iteration) {
      p.field(t + h / 2, middle, rate);
      for (std::size_t k = 0; k < z.size(); ++k) middle[k] = z[k] + h / 2 * rate[k];
    }
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * rate[k];
    return Status::converged;
  }
};

template <class X>
void oscillator(const X& x, X& rate, double /*t*/) {
  rate[0] = x[1];
  rate[1] = -x[0];
}

template <class X>
void drive() {
  OdeintStepper<Midpoint, X> stepper(Midpoint{}, 2);
  X x{1.0, 0.0};
  std::size_t observed = 0;
  const std::size_t steps = boost::numeric::odeint::integrate_const(stepper, oscillator<X>, x, 0.0, 10.0, 0.1,
                                                                    [&](const X&, double) { ++observed; });
  EXPECT_EQ(steps, 100U);
  EXPECT_EQ(observed, 101U);
  // A quadratic invariant: kept to round-off, about one rounding a step.
  EXPECT_NEAR(x[0] * x[0] + x[1] * x[1], 1, 1e-14);
  // The midpoint rule turns by 2 atan(h/2) a step.
  const double angle = 200 * std::atan(0.05);
  EXPECT_NEAR(x[0], std::cos(angle), 1e-13);
  EXPECT_NEAR(x[1], -std::sin(angle), 1e-13);
}

TEST(OdeintConcept, IntegrateConstDrivesAMethodOfOurs) {
  drive<std::vector<double>>();
  drive<std::array<double, 2>>();
}

// The damped pendulum of the registered system, as a function for odeint.
void damped_pendulum(const std::vector<double>& x, std::vector<double>& rate, double /*t*/) {
  rate[0] = x[1];
  rate[1] = -std::sin(x[0]) - 0.3 * x[1];
}

// z_{n+1} - z_{n-1} = 2 h X(z_n): the state two steps ago, not only the last one, decides about the next.
TEST(OdeintConcept, AMethodWithHistoryKeepsItFromStepToStep) {
  std::vector<std::vector<double>> states;
  std::vector<double> x{1, 0.5};
  boost::numeric::odeint::integrate_const(
      OdeintStepper<LeapFrog>(LeapFrog{}, 2), damped_pendulum, x, 0.0, 100 * 0.05, 0.05,
      [&](const std::vector<double>& state, double) { states.push_back(state); });
  ASSERT_EQ(states.size(), 101U);
  std::vector<double> rate(2);
  for (std::size_t n = 1; n < 100; ++n) {
    damped_pendulum(states[n], rate, 0);
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_NEAR(states[n + 1][k] - states[n - 1][k], 2 * 0.05 * rate[k], 1e-15) << n;
  }
  // The same numbers as Pfaff's own loop makes of the same function.
  using Function = void(const std::vector<double>&, std::vector<double>&, double);
  using P = FunctionProblem<Function, std::vector<double>>;
  const std::vector<double> start{1, 0.5};
  const P problem(damped_pendulum, start);
  LeapFrog::Work<P> work(LeapFrog{}, problem);
  auto z = problem.make_state();
  std::copy(start.begin(), start.end(), z.begin());
  std::int64_t completed = 0;
  ASSERT_EQ(advance(LeapFrog{}, problem, 0.0, 0, 0.05, 100, z, work, completed), Status::converged);
  EXPECT_EQ(x, std::vector<double>(z.begin(), z.end()));
}

// A method that trusts its workspace without looking at where the step begins.
struct Trusting {
  template <class P>
  struct Work {
    double steps = 0;
    Work(const Trusting& /*method*/, const P& /*problem*/) {}
  };
  template <HasVectorField P>
  Status step(const P& /*p*/, const Scalar<P>& /*t*/, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    z[0] = z[0] + h * w.steps;
    w.steps += 1;
    return Status::converged;
  }
};

// What does not follow on from the last step starts anew, as a stepper does that has taken none.
template <class M>
void expect_history_ends() {
  const std::vector<double> start{1, 0.5};
  OdeintStepper<M> used(M{}, 2);
  std::vector<double> after = start;
  for (int n = 0; n < 3; ++n) used.do_step(damped_pendulum, after, 0.1 * n, 0.1);
  const auto stepped = [](OdeintStepper<M> stepper, std::vector<double> x, double t, double dt) {
    stepper.do_step(damped_pendulum, x, t, dt);
    return x;
  };
  const auto fresh = [&](const std::vector<double>& x, double t, double dt) {
    return stepped(OdeintStepper<M>(M{}, 2), x, t, dt);
  };
  std::vector<double> next = after;
  OdeintStepper<M> copy = used;
  used.do_step(damped_pendulum, next, 0.3, 0.1);
  EXPECT_NE(next, fresh(after, 0.3, 0.1)) << "control: this step does follow";
  EXPECT_EQ(stepped(copy, after, 0.3, 0.1), fresh(after, 0.3, 0.1)) << "a copy";
  const auto twice = [&](const std::vector<double>& x, double t, double dt) {
    OdeintStepper<M> stepper(M{}, 2);
    std::vector<double> z = start;
    for (int n = 0; n < 3; ++n) stepper.do_step(damped_pendulum, z, 0.1 * n, 0.1);
    z = x;
    stepper.do_step(damped_pendulum, z, t, dt);
    return z;
  };
  EXPECT_EQ(twice(after, 0.3, 0.1), next) << "control";
  EXPECT_EQ(twice(start, 0.3, 0.1), fresh(start, 0.3, 0.1)) << "another state";
  EXPECT_EQ(twice(after, 0.7, 0.1), fresh(after, 0.7, 0.1)) << "another time";
  EXPECT_EQ(twice(after, 0.3, 0.2), fresh(after, 0.3, 0.2)) << "another step";
  OdeintStepper<M> again(M{}, 2);
  std::vector<double> z = start;
  for (int n = 0; n < 3; ++n) again.do_step(damped_pendulum, z, 0.1 * n, 0.1);
  again.reset();
  again.do_step(damped_pendulum, z, 0.3, 0.1);
  EXPECT_EQ(z, fresh(after, 0.3, 0.1)) << "reset";
}

TEST(OdeintConcept, HistoryEndsWhereStepsDoNotFollowOneAnother) {
  expect_history_ends<LeapFrog>();
  expect_history_ends<Trusting>();
}

TEST(OdeintConcept, AFailedStepIsAnError) {
  struct Fails {
    Status step(const FunctionProblem<void (*)(const std::vector<double>&, std::vector<double>&, double),
                                      std::vector<double>>&,
                const double&, const double&, Vector<double, dynamic>&, NoWork&) const {
      return Status::not_converged;
    }
  };
  OdeintStepper<Fails> stepper(Fails{});
  std::vector<double> x{1, 0};
  void (*system)(const std::vector<double>&, std::vector<double>&, double) = oscillator<std::vector<double>>;
  EXPECT_THROW(stepper.do_step(system, x, 0.0, 0.1), std::runtime_error);
}

}  // namespace
}  // namespace pfaff
