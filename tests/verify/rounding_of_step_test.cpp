// Rounding is told from errors: residuals that move with every input, residuals that do not.
#include <random>

#include <gtest/gtest.h>

#include <pfaff/verify/rounding_of_step.hpp>

namespace {
using namespace pfaff;

std::vector<double> residuals(double error, double rounding) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<double> list;
  for (int k = 0; k < moved_steps; ++k) list.push_back(error + rounding * part(random));
  return list;
}

TEST(RoundingOfAStep, IsAnotherNumberWhereInputsMove) {
  EXPECT_TRUE(is_rounding(residuals(0, 3e-13), 1e-14));
  EXPECT_FALSE(is_rounding(residuals(3e-13, 0), 1e-14));
  EXPECT_FALSE(is_rounding(residuals(3e-13, 1e-15), 1e-14));
}

TEST(RoundingOfAStep, IsNotLargerThanAMotionMultipliesIt) {
  EXPECT_TRUE(is_rounding(residuals(0, 1e-9), 1e-14));
  EXPECT_FALSE(is_rounding(residuals(0, 1e-3), 1e-14));
  EXPECT_FALSE(is_rounding({std::vector<double>(moved_steps, std::nan(""))}, 1e-14));
}

TEST(RoundingOfAStep, MovesEveryCoordinateByAUnit) {
  const std::vector<Real> start{Real(1), Real::fraction(-1, 3)};
  bool up = false, down = false;
  for (int seed = 1; seed <= moved_steps; ++seed) {
    const std::vector<Real> moved = moved_by_a_unit<double>(start, seed);
    for (std::size_t k = 0; k < start.size(); ++k) {
      const double change = moved[k].value() - start[k].value();
      EXPECT_NEAR(std::abs(change), 2.2e-16 * std::abs(start[k].value()), 1.2e-16);
      (change > 0 ? up : down) = true;
    }
  }
  EXPECT_TRUE(up && down);
}

}  // namespace
