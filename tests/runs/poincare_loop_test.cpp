// Poincare's integral invariant along methods: a loop of states that they carry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "measured_table.hpp"

namespace pfaff {
namespace {

using testing::fits;
using testing::to_measure;
using testing::ToMeasure;

ToMeasure looped(const std::string& system, const std::string& method, const Assignments& set = {},
                 const std::string& step = "0.1") {
  return to_measure(system, method, step, set, 20);
}

struct CarriedLoop {
  double t, integral, uncertainty;
};
std::vector<CarriedLoop> carry_loop(const ToMeasure& run, int looks) {
  std::vector<CarriedLoop> loops;
  const MeasuredTable table = table_of("poincare-loop(looks=" + std::to_string(looks) + ")", run);
  for (const MeasuredTable::Line& line : table.lines)
    loops.push_back({time_of(line, run), testing::number(line, 0), testing::number(line, 1)});
  return loops;
}

// While the loop is resolved, as reports draw it.
double largest_change(const std::vector<CarriedLoop>& loops) {
  double worst = 0;
  std::size_t resolved = 0;
  while (resolved < loops.size() && loops[resolved].uncertainty <= 1e-6)
    worst = std::max(worst, std::abs(loops[resolved++].integral - 1));
  EXPECT_GE(resolved, 10U);
  return worst;
}

TEST(LoopInvariant, OfCanonicalAndBirkhoffianSystemsWithoutConstraints) {
  EXPECT_TRUE(fits("poincare-loop", looped("kepler", "rk4")));
  EXPECT_TRUE(fits("poincare-loop", looped("damped-pendulum", "rk4")));
  EXPECT_TRUE(fits("poincare-loop", looped("lotka-volterra", "rk4")));
  EXPECT_FALSE(fits("poincare-loop", looped("spherical-pendulum", "rattle")));
  EXPECT_FALSE(fits("poincare-loop", looped("relaxing-rigid-body", "rk4")));
}

// A loop of 64 points and of size 1/1000 is known to 1e-16 * 1000 * 64, a few times over; kept where steps
// are symplectic, or keep K(z, t) of the damped pendulum, and lost by the same orders of magnitude as
// structure otherwise.
TEST(LoopInvariant, StaysWhereStepsKeepTheStructure) {
  // Three times round an ellipse the loop is a hundred times as long, and so are the errors: a few times
  // 1e-16 * 1000 * 64 * 100.
  for (const char* method : {"verlet", "gauss", "implicit-midpoint"})
    EXPECT_LT(largest_change(carry_loop(looped("kepler", method, {}, "0.05"), 40)), 2e-9) << method;
  EXPECT_GT(largest_change(carry_loop(looped("kepler", "rk4", {}, "0.05"), 40)), 1e-7);

  EXPECT_LT(largest_change(carry_loop(looped("damped-pendulum", "generating-function"), 40)), 3e-11);
  EXPECT_LT(largest_change(carry_loop(looped("damped-pendulum", "gauss-darboux"), 40)), 3e-11);
  EXPECT_GT(largest_change(carry_loop(looped("damped-pendulum", "implicit-midpoint"), 40)), 1e-5);

  EXPECT_LT(largest_change(carry_loop(looped("lotka-volterra", "generating-function"), 40)), 3e-11);
  EXPECT_GT(largest_change(carry_loop(looped("lotka-volterra", "implicit-midpoint"), 40)), 1e-7);
}

// Of the oscillator the integral is an area: it changes by the determinant of a step of RK4, step by step.
TEST(LoopInvariant, OfALinearSystemIsTheDeterminantOfTheSteps) {
  const auto loops = carry_loop(looped("harmonic-oscillator", "rk4"), 20);
  ASSERT_EQ(loops.size(), 21U);
  const double h = 0.1, even = 1 - h * h / 2 + std::pow(h, 4) / 24, odd = h - h * h * h / 6;
  const double determinant = even * even + odd * odd;
  for (const CarriedLoop& loop : loops)
    EXPECT_NEAR(loop.integral, std::pow(determinant, loop.t / h), 3e-11) << loop.t;
  EXPECT_GT(std::abs(loops.back().integral - 1), 1e-6);
}

// Half of the points say as much while the loop is smooth, and no longer once it is wound up.
TEST(LoopInvariant, TellsWhenALoopIsNoLongerResolved) {
  const auto loops = carry_loop(to_measure("kepler", "verlet", "0.2", {}, 200), 40);
  ASSERT_EQ(loops.size(), 41U);
  EXPECT_LT(loops[1].uncertainty, 1e-9);
  EXPECT_GT(loops.back().uncertainty, 1e-3);
}

// Ten points of a small circle resolve it, and so do five, an odd number with weights of its own.
TEST(LoopInvariant, OfFewPointsIsTheSame) {
  const ToMeasure run = looped("harmonic-oscillator", "verlet");
  EXPECT_FALSE(fits("poincare-loop(points=9)", run));
  for (const MeasuredTable::Line& line : table_of("poincare-loop(points=10)", run).lines) {
    EXPECT_NEAR(testing::number(line, 0), 1, 1e-11) << line.step;
    EXPECT_LT(testing::number(line, 1), 1e-11) << line.step;
  }
}

// In quad the integral is known as well as states are: 64 points of a loop of size 1/1000.
TEST(LoopInvariant, IsMeasuredInThePrecisionOfTheRun) {
  const auto run = integrate<Quad>("pendulum", {}, "verlet", {}, {.step = "0.1"});
  const auto measure = measure_asked_for("poincare-loop(steps=20, looks=4)");
  const MeasuredTable table = measured(run, 20, {measure.get()}).front();
  ASSERT_EQ(table.lines.size(), 5U);
  for (const MeasuredTable::Line& line : table.lines)
    EXPECT_LT(abs(std::get<Quad>(line.cells[0]) - Quad(1)), Quad(1e-28)) << line.step;
}

}  // namespace
}  // namespace pfaff
