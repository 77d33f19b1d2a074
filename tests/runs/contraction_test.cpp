// A disc of states carried along by methods: its area against the law of the system.
#include <gtest/gtest.h>

#include <cmath>

#include "measured_table.hpp"

namespace pfaff {
namespace {

using testing::fits;
using testing::to_measure;
using testing::ToMeasure;

ToMeasure run_of(const std::string& system, const std::string& method, const Assignments& set = {}) {
  return to_measure(system, method, "0.4", set, 40);
}

struct CarriedDisc {
  double t, area, law;
};
std::vector<CarriedDisc> carry_disc(const ToMeasure& run, int looks) {
  std::vector<CarriedDisc> discs;
  const MeasuredTable table = table_of("contraction(looks=" + std::to_string(looks) + ")", run);
  for (const MeasuredTable::Line& line : table.lines)
    discs.push_back({time_of(line, run), testing::number(line, 0), testing::number(line, 1)});
  return discs;
}

const Assignments damped{{"nu", "0.2"}};

TEST(Contraction, OfSystemsThatStateIt) {
  EXPECT_TRUE(fits("contraction", run_of("damped-oscillator", "rk4")));
  EXPECT_TRUE(fits("contraction", run_of("damped-pendulum", "rk4")));
  EXPECT_FALSE(fits("contraction", run_of("damped-oscillator", "rk4", {{"nu", "0"}})));  // nothing to see
  EXPECT_FALSE(fits("contraction", run_of("harmonic-oscillator", "rk4")));
  EXPECT_FALSE(fits("contraction", run_of("lotka-volterra", "rk4")));
  EXPECT_FALSE(fits("contraction", run_of("kepler", "rk4")));
}

// Every area shrinks by e^{-nu t}: to the last digit by a scheme that keeps the structure e^{nu t} dr ^ dp of
// a linear system, and by another one only as far as it is accurate.
TEST(Contraction, OfALinearSystemIsKeptByWhoKeepsTheStructure) {
  const auto kept = carry_disc(run_of("damped-oscillator", "generating-function", damped), 60);
  const auto lost = carry_disc(run_of("damped-oscillator", "rk4", damped), 60);
  ASSERT_EQ(kept.size(), lost.size());
  EXPECT_EQ(kept.front().area, 1);
  EXPECT_EQ(kept.front().law, 1);
  EXPECT_NEAR(kept.back().t, 15 - 0.2, 0.3);  // e^{-0.2 t} has come to e^{-3}
  for (const CarriedDisc& disc : kept) {
    EXPECT_DOUBLE_EQ(disc.law, std::exp(-0.2 * disc.t));
    EXPECT_NEAR(disc.area / disc.law, 1, 1e-12);
  }
  EXPECT_GT(std::abs(lost.back().area / lost.back().law - 1), 1e-4);
}

// The determinant of the tangent map is e^{-nu t} along every orbit, to the round-off of the implicit solves;
// what the midpoint rule loses at this step is more.
TEST(Contraction, OfANonlinearSystemIsSeenAsWell) {
  const Assignments strongly{{"nu", "1"}};
  const auto kept = carry_disc(run_of("damped-pendulum", "generating-function", strongly), 60);
  const auto lost = carry_disc(run_of("damped-pendulum", "implicit-midpoint", strongly), 60);
  EXPECT_NEAR(kept.back().area / kept.back().law, 1, 1e-11);
  EXPECT_GT(std::abs(lost.back().area / lost.back().law - 1), 2e-2);
}

TEST(Contraction, ShowsTheOutlineAtSixOfTheLooks) {
  const MeasuredTable table = table_of("contraction", run_of("damped-oscillator", "rk4", damped));
  std::size_t shown = 0;
  for (const MeasuredTable::Line& line : table.lines)
    shown += std::get<std::string>(line.cells[2]).empty() ? 0 : 1;
  EXPECT_EQ(shown, 6U);
  EXPECT_FALSE(std::get<std::string>(table.lines.front().cells[2]).empty());
  EXPECT_FALSE(std::get<std::string>(table.lines.back().cells[2]).empty());
}

}  // namespace
}  // namespace pfaff
