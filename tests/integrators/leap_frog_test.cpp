// The leap-frog scheme: its two-step rule, its order over many steps, and that it neither preserves the
// structure nor is stable where the motion is damped.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/runs/support/structure.hpp>

#include "methods.hpp"

namespace pfaff {
namespace {

using testing::after_steps;
using testing::method_named;

TEST(LeapFrog, LeapsFromTheStateBefore) {
  const auto model = systems().get("damped-pendulum", "system").make({});
  const Problem<Quad> problem(model);
  const auto method = method_named("leap-frog");
  const Quad h(0.05);
  std::vector<std::vector<Quad>> z{{Quad(1), Quad(0.5)}};
  Integration<Quad> run(start_with(*method, model, z.front(), h, Quad(0)));
  for (std::int64_t n = 0; n < 6; ++n) {
    run.steps(1).expect_reached();
    z.emplace_back(run.state().begin(), run.state().end());
  }
  std::vector<Quad> rate(2);
  for (std::size_t n = 1; n < 6; ++n) {
    problem.field(Quad(int(n)) * h, z[n], rate);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_LE(static_cast<double>(abs(z[n + 1][k] - z[n - 1][k] - Quad(2) * h * rate[k])), 1e-33);
  }
  EXPECT_EQ(run.counters().fields, 7);  // one a step, and one more to start
}

TEST(LeapFrog, IsOfOrderTwoOverManySteps) {
  const auto model = systems().get("damped-pendulum", "system").make({});
  std::vector<Quad> exact{Quad(1), Quad(0.5)};
  for (int k = 0; k < 20; ++k) taylor_flow(*model, Quad(k) / Quad(10), Quad(1) / Quad(10), exact);
  const auto error = [&](std::int64_t steps) {
    const auto z = after_steps<Quad>(*method_named("leap-frog"), model, Quad(2) / Quad(int(steps)), steps,
                                     {Quad(1), Quad(0.5)});
    return static_cast<double>(
        sqrt((z[0] - exact[0]) * (z[0] - exact[0]) + (z[1] - exact[1]) * (z[1] - exact[1])));
  };
  EXPECT_NEAR(std::log2(error(800) / error(1600)), 2, 0.05);
}

struct DriftFlow {
  static constexpr int dimension = 1;
  template <class T>
  void field(const T& /*t*/, In<T> /*z*/, Out<T> rate) const {
    rate[0] = T(Real::fraction(1, 10));
  }
};

// A hundred thousand equal increments: only sums are rounded. Even and odd states are two sums, each with a
// compensation of its own, which leaves the rounding of the last one.
TEST(LeapFrog, BothSumsAreCompensated) {
  static const System<DriftFlow> plugin{
      {.name = "drift", .title = "", .reference = "", .initial = {Real(0)}}};
  const std::int64_t steps = 100000;
  const double h = 0.1, expected = static_cast<double>(steps / 2) * (2 * h * 0.1);
  const double unit = std::ldexp(1.0, -43);  // in the last place of 1000
  for (const bool compensated : {true, false}) {
    const auto leaps = method_named("leap-frog", {{"compensated", compensated ? "yes" : "no"}});
    const auto z = after_steps<double>(*leaps, plugin.make({}), h, steps, {0});
    EXPECT_EQ(std::abs(z[0] - expected) <= unit, compensated) << z[0] - expected;
  }
}

TEST(LeapFrog, IsNotKSymplectic) {
  const auto model = systems().get("damped-pendulum", "system").make({});
  StructureResidual<Quad> residual(*method_named("leap-frog"), model);
  EXPECT_GT(static_cast<double>(residual(Quad(0), Quad(0.1), {Quad(1), Quad(0.5)})), 1e-8);
}

TEST(LeapFrog, IsUnstableWhereMotionIsDamped) {
  // The motion decays as e^{-nu t/2}, the parasitic oscillation grows as e^{nu t/2} from about h^3.
  const auto model = systems().get("damped-oscillator", "system").make({});
  const auto size = [&](const char* name) {
    const auto z = after_steps<double>(*method_named(name), model, 0.1, 1000, {1, 0});
    return std::hypot(z[0], z[1]);
  };
  EXPECT_GT(size("leap-frog"), 1);
  for (const char* name : {"gauss-darboux", "yoshida", "conformal-splitting", "rk4"})
    EXPECT_LT(size(name), 1e-6) << name;
}

}  // namespace
}  // namespace pfaff
