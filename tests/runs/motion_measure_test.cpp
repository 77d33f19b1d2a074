// The measure `motion`: stretches of a run, all of their steps, beside the solution.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/registry/registry.hpp>
#include <pfaff/runs/support/plane.hpp>
#include <pfaff/tests/runs/measured_table.hpp>

namespace {
using namespace pfaff;
using namespace pfaff::testing;

enum Cell : std::size_t { stretch = 2, x, y, exact_x, exact_y, between_x, between_y };

// A step of the implicit midpoint rule turns the oscillator, from (1, 0), by 2 atan(h/2).
TEST(MotionMeasure, HasEveryStepOfItsStretchesBesideTheExactMotion) {
  constexpr double h = 0.1;
  const MeasuredTable table =
      table_of("motion", to_measure("harmonic-oscillator", "implicit-midpoint", "0.1", {}, 100));
  std::map<int, std::vector<std::int64_t>> steps;
  for (const auto& line : table.lines) {
    const double n = static_cast<double>(line.step), angle = n * 2 * std::atan(h / 2);
    // A thousand steps of a few roundings, and those of the angle.
    EXPECT_NEAR(number(line, x), std::cos(angle), 1e-12);
    EXPECT_NEAR(number(line, y), -std::sin(angle), 1e-12);
    EXPECT_NEAR(number(line, exact_x), std::cos(n * h), 1e-13);
    EXPECT_NEAR(number(line, exact_y), -std::sin(n * h), 1e-13);
    const std::vector<std::int64_t>& before = steps[static_cast<int>(number(line, stretch))];
    EXPECT_EQ(std::isnan(number(line, between_x)), before.empty()) << "at the first step of a stretch alone";
    if (!before.empty()) {
      EXPECT_NEAR(number(line, between_x), std::cos((n - 0.5) * h), 1e-13);
      EXPECT_NEAR(number(line, between_y), -std::sin((n - 0.5) * h), 1e-13);
    }
    EXPECT_EQ(std::get<std::string>(line.cells[0]), "q [m]");
    EXPECT_EQ(std::get<std::string>(line.cells[1]), "p [m/s]");
    steps[static_cast<int>(number(line, stretch))].push_back(line.step);
  }
  ASSERT_EQ(steps.size(), 5U);
  // The track turns with the angle, of which the first step has none before it: 63 steps to 2 pi, and one
  // more.
  const auto length = static_cast<std::int64_t>(std::ceil(2 * std::numbers::pi / h)) + 1;
  for (const auto& [k, of_stretch] : steps) {
    ASSERT_EQ(of_stretch.size(), static_cast<std::size_t>(length) + 1);
    EXPECT_EQ(of_stretch.front(), (1000 - length) * (k - 1) / 4);
    for (std::size_t i = 1; i < of_stretch.size(); ++i) EXPECT_EQ(of_stretch[i], of_stretch[i - 1] + 1);
  }
}

TEST(MotionMeasure, HasTheSameStepsForAllMethods) {
  std::set<std::vector<std::int64_t>> found;
  for (const char* method : {"implicit-midpoint", "rk4", "symplectic-euler"}) {
    std::vector<std::int64_t> steps;
    for (const auto& line : table_of("motion", to_measure("kepler", method, "0.1", {}, 100)).lines)
      steps.push_back(line.step);
    found.insert(steps);
  }
  EXPECT_EQ(found.size(), 1U);
}

// Sixteen steps to 2 pi, and one more; with fewer than twelve a turn a stretch is longer than one.
TEST(MotionMeasure, HasOneTurnOfLongStepsToo) {
  for (const auto& [step, expected] : {std::pair("0.4", 17), {"0.8", 12}}) {
    std::map<int, int> rows;
    for (const auto& line : table_of("motion", to_measure("harmonic-oscillator", "rk4", step, {}, 100)).lines)
      ++rows[static_cast<int>(number(line, stretch))];
    for (const auto& [k, count] : rows) EXPECT_EQ(count, expected + 1) << step << ", stretch " << k;
  }
}

// A run of less than two turns is one stretch.
TEST(MotionMeasure, ShowsAShortRunWhole) {
  const MeasuredTable table = table_of("motion", to_measure("harmonic-oscillator", "rk4", "0.1", {}, 10));
  ASSERT_EQ(table.lines.size(), 101U);
  for (const auto& line : table.lines) EXPECT_EQ(number(line, stretch), 1);
}

TEST(MotionMeasure, LeavesTheExactMotionEmptyWhereItIsNotAskedForOrEnds) {
  const auto asked = measure_asked_for("motion(exact=no)");
  const ToMeasure run = to_measure("harmonic-oscillator", "rk4", "0.1", {}, 100);
  const MeasuredTable table = measured(run.start, run.steps, {asked.get()}).front();
  EXPECT_EQ(table.ended, "");
  for (const auto& line : table.lines) {
    EXPECT_TRUE(std::isfinite(number(line, x)));
    EXPECT_TRUE(std::isnan(number(line, exact_x)) && std::isnan(number(line, between_x)));
  }
}

TEST(MotionMeasure, TakesTheCoordinatesThatAreNamed) {
  const MeasuredTable table = table_of("motion(x=p2, y=q1)", to_measure("kepler", "rk4", "0.1", {}, 2));
  EXPECT_EQ(std::get<std::string>(table.lines[0].cells[0]), "p2");
  EXPECT_EQ(std::get<std::string>(table.lines[0].cells[1]), "q1");
  const ToMeasure run = to_measure("kepler", "rk4", "0.1", {}, 1);
  EXPECT_THROW((void)fits("motion(x=q1, y=qq2)", run), InputError);
  EXPECT_FALSE(fits("motion(x=q1)", run));
}

TEST(PlaneOf, IsOfCoordinatesWithOneUnit) {
  const auto of = [](const char* system) { return plane_of(*systems().get(system, "system").make({})); };
  using Pair = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(of("harmonic-oscillator"), Pair(0, 1));  // q and p, whatever their units
  EXPECT_EQ(of("kepler"), Pair(0, 1));
  EXPECT_EQ(of("rolling-disk"), Pair(0, 1));
}
}  // namespace
