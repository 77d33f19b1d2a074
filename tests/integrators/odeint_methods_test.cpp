// Boost.Odeint's steppers as registered methods.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

// dopri5 keeps the last slope of a step for the next one, which is another where the state has been changed
// in between.
TEST(OdeintMethods, AStepDependsOnItsOwnStateAlone) {
  const auto model = systems().get("henon-heiles", "system").make({});
  for (const char* name : {"odeint-rk4", "odeint-dopri5", "odeint-mclachlan"}) {
    const auto method = integrators().get(name, "integrator").make({});
    const auto used = method->stepper(model, double()), fresh = method->stepper(model, double());
    std::vector<double> z{0.1, -0.2, 0.3, 0.05};
    std::int64_t completed = 0;
    ASSERT_EQ(used->advance(0, 0, 0.1, 3, z, completed), Status::converged) << name;
    const std::vector<double> elsewhere{-0.3, 0.1, 0.2, 0.4};
    std::vector<double> after_others = elsewhere, alone = elsewhere;
    ASSERT_EQ(used->advance(0, 3, 0.1, 1, after_others, completed), Status::converged) << name;
    ASSERT_EQ(fresh->advance(0, 3, 0.1, 1, alone, completed), Status::converged) << name;
    EXPECT_EQ(after_others, alone) << name;
  }
}
// A step moves the state by as much as it moves the time. Late times are rounded more coarsely than steps are
// chosen.
TEST(OdeintMethods, LateTimesCostNoDigits) {
  const auto model = systems().get("harmonic-oscillator", "system").make({});
  for (const char* name : {"odeint-dopri5", "odeint-bulirsch-stoer"})
    for (const double t0 : {0.0, 1e6, 1e9}) {
      const auto method = integrators().get(name, "integrator").make({});
      const auto stepper = method->stepper(model, double());
      std::vector<double> z{1, 0};
      double t = t0;
      ASSERT_EQ(stepper->advance_to(t, t0 + 100, 1e-10, z), Status::converged) << name;
      // A hundred radians at some 1e-9 an error; what steps and times differed by was 4e-5 at t0 = 1e9.
      EXPECT_NEAR(z[0], std::cos(100.0), 1e-7) << name << t0;
    }
}
}  // namespace
