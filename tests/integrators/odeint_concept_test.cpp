// Methods of ours under Boost.Odeint's drivers.
#include <gtest/gtest.h>

#include <boost/numeric/odeint/integrate/integrate_const.hpp>
#include <cmath>

#include <pfaff/core/odeint/stepper.hpp>
#include <pfaff/core/solve/status.hpp>

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
