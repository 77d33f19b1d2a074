// Integrations with derivatives with respect to their state.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/runs/integrate.hpp>

namespace pfaff {
namespace {

// Steps of the midpoint rule turn the harmonic oscillator by twice the angle whose tangent is h / 2.
TEST(DifferentiatedIntegration, IsTheTangentMap) {
  auto run = integrate("harmonic-oscillator", {}, "implicit-midpoint", {}, {.step = "0.1"}).differentiated();
  EXPECT_TRUE(run.steps(50).reached());
  const double angle = 100 * std::atan(0.05), round_off = 100 * 0x1p-52;
  EXPECT_NEAR(run.state()[0].derivative[0], std::cos(angle), round_off);
  EXPECT_NEAR(run.state()[0].derivative[1], std::sin(angle), round_off);
  EXPECT_NEAR(run.state()[1].derivative[0], -std::sin(angle), round_off);
  EXPECT_NEAR(run.state()[1].derivative[1], std::cos(angle), round_off);

  // From where the run is, and from any component on.
  auto kepler = integrate("kepler", {}, "verlet", {}, {.step = "0.1"});
  EXPECT_TRUE(kepler.steps(3).reached());
  auto all = kepler.differentiated(), last_two = kepler.differentiated(2);
  EXPECT_TRUE(all.steps(20).reached());
  EXPECT_TRUE(last_two.steps(20).reached());
  EXPECT_TRUE(kepler.steps(20).reached());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(all.state()[i].value, kepler.state()[i], 64 * 0x1p-52);  // the dual division rounds otherwise
    EXPECT_EQ(all.state()[i].derivative[2], last_two.state()[i].derivative[0]);
    EXPECT_EQ(all.state()[i].derivative[3], last_two.state()[i].derivative[1]);
    EXPECT_EQ(last_two.state()[i].derivative[2], 0);
  }
  EXPECT_DOUBLE_EQ(value_of(all.time()), kepler.time());  // counted from another start
}

}  // namespace
}  // namespace pfaff
