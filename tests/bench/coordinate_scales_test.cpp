// The sizes of coordinates, and states at which claims are measured of systems whose coordinates have very
// different ones.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/bench/verification/check.hpp>
#include <pfaff/bench/verification/step_scale.hpp>

namespace {
using namespace pfaff;

TEST(CoordinateScales, ZerosTakeTheSizeOfTheirUnit) {
  const std::vector<Real> z{100, 0, Real::fraction(1, 1024), 0, 0, 2};
  const std::vector<Coordinate> named{{"x", "m"},  {"y", "m"}, {"p", "kg"},
                                      {"r", "kg"}, {"s", "K"}, {"w", ""}};
  EXPECT_EQ(coordinate_scales(z, named), (std::vector<double>{128, 128, 1.0 / 1024, 1.0 / 1024, 128, 1}));
  // Without units all zeros take that of the largest.
  EXPECT_EQ(coordinate_scales(z), (std::vector<double>{128, 128, 1.0 / 1024, 128, 128, 1}));
}

// Momenta of planets are 1e-11 to 1e-5 of their positions. Moved by about one they would be faster than
// light; moved by a part of their size they stay below a tenth of an astronomical unit a day.
TEST(CoordinateScales, PlanetsAreMovedByAPartOfTheirOwnMomenta) {
  const auto model = systems().get("outer-solar-system", "system").make({});
  const std::vector<Real> z = generic_state(*model);
  const std::vector<double> masses{1, 9.5e-4, 2.9e-4, 4.4e-5, 5.2e-5, 7.7e-9};
  for (std::size_t k = 0; k < 18; ++k) {
    EXPECT_NE(z[18 + k], model->initial()[18 + k]) << k;
    EXPECT_LT(std::abs(z[18 + k].value()) / masses[k % 6], 0.1) << k;
  }
}

}  // namespace
