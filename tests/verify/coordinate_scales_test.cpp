// States at which claims are measured of systems whose coordinates have very different sizes.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/verify/check.hpp>

namespace {
using namespace pfaff;

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
