// States at which claims are measured of systems whose coordinates have very different sizes.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include <pfaff/systems/text/text_system.hpp>
#include <pfaff/verify/check.hpp>
#include <pfaff/verify/step_scale.hpp>

#include "../temporary_directory.hpp"
#include "judged.hpp"

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

// Springs of equal length far from the ends of a lattice pull a particle that rests there both ways: its
// momentum has the size of these forces, and not of what they round, with which the order of every method was
// judged at round-off.
TEST(CoordinateScales, ForcesThatCancelTellTheSizeOfAMomentum) {
  constexpr std::size_t n = 14;
  const pfaff::testing::TemporaryDirectory files;
  std::ofstream(files / "plucked.toml")
      << "name = \"plucked\"\ntitle = \"a lattice\"\nreference = \"hairer-lubich-wanner2006\"\n"
         "coordinates = { q = 14, p = 14 }\ninitial = [\"vector(i, 1, 14, i/50)\", \"vector(i, 1, 14, 0)\"]\n"
         "kinetic = \"sum(i, 1, 14, p[i]^2)/2\"\n"
         "potential = \"(q[1]^2 + q[14]^2)/2 + sum(i, 1, 13, (q[i+1] - q[i])^2/2 + (q[i+1] - q[i])^4/4)\"\n";
  const auto model = system_named(files / "plucked.toml").make({});
  const std::vector<Real> z = generic_state(*model);
  for (std::size_t k = n; k < 2 * n; ++k) EXPECT_GT(std::abs(z[k].value()), 1e-4) << k;
  EXPECT_EQ(own_time(*model, Real(0), z), Quad(1));
  const auto gauss = integrators().get("gauss", "integrator").make({{"stages", "2"}});
  EXPECT_EQ(pfaff::testing::bad(check_method(*gauss, {}, "plucked", model, false)), pfaff::testing::Names{});
}

}  // namespace
