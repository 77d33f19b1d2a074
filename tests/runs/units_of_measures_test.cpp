// What measures say of a run does not depend on the units in which its system is written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <pfaff/core/system.hpp>

#include "measured_table.hpp"

namespace pfaff {
namespace {

using testing::number;
using testing::table_of;
using testing::ToMeasure;

Real power_of_two(int exponent) { return Real(Quad(std::exp2(exponent))); }

// A hardening spring whose lengths are counted in units of 2^-length and whose momenta in units of
// 2^-momentum, as those of an electron in metres, kilograms and seconds are. All numbers of a step are those
// of the spring in units of one, times powers of two. Sizes stay within a factor of the root of two of the
// units.
template <int length, int momentum>
struct Spring {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return T(power_of_two(momentum - length)) * (p[0] * p[0] / 2);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T x = T(power_of_two(length)) * q[0];
    return T(power_of_two(-length - momentum)) * (x * x / 2 + x * x * x * x / 4);
  }
};
template <int length, int momentum>
ToMeasure sprung(const char* method) {
  static const System<Spring<length, momentum>> plugin{
      {.name = "spring",
       .title = "",
       .reference = "",
       .initial = {0.8_r * power_of_two(-length), 0.8_r * power_of_two(-momentum)}}};
  return {integrate(plugin.make({}), integrators().get(method, "").make({}), 0.05), 400};
}

// The spring of a light body beside a heavy one that is free, on which every method is symplectic.
struct SpringBesideFree {
  static constexpr int dimension = 4;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2 + T(power_of_two(40)) * (p[1] * p[1] / 2);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return T(power_of_two(-40)) * (q[1] * q[1] / 2 + q[1] * q[1] * q[1] * q[1] / 4);
  }
};
ToMeasure beside_free(const char* method) {
  static const System<SpringBesideFree> plugin{{.name = "spring-beside-free",
                                                .title = "",
                                                .reference = "",
                                                .initial = {0, 0.8_r, 1, 0.8_r * power_of_two(-40)}}};
  return {integrate(plugin.make({}), integrators().get(method, "").make({}), 0.05), 400};
}

double largest(const MeasuredTable& table) {
  double worst = 0;
  for (const auto& line : table.lines) worst = std::max(worst, std::abs(number(line, 0)));
  return worst;
}

// Units are made of powers of two, and the size that stands below the residual may be another entry of the
// matrix: the residuals agree within a factor of four.
TEST(UnitsOfMeasures, DoNotHideWhetherTheStructureIsKept) {
  const double of_rk4 = largest(table_of("structure", sprung<0, 0>("rk4")));
  EXPECT_GT(of_rk4, 1e-9);
  EXPECT_NEAR(std::log2(largest(table_of("structure", sprung<30, 100>("rk4"))) / of_rk4), 0, 2);
  EXPECT_NEAR(std::log2(largest(table_of("structure", beside_free("rk4"))) / of_rk4), 0, 2);
  for (const char* method : {"verlet", "gauss"}) {
    EXPECT_LT(largest(table_of("structure", sprung<0, 0>(method))), 1e-15) << method;
    EXPECT_LT(largest(table_of("structure", sprung<30, 100>(method))), 1e-15) << method;
    EXPECT_LT(largest(table_of("structure", beside_free(method))), 1e-15) << method;
  }
}

// Scales are powers of two: every point of the loop is the same to the last bit.
TEST(UnitsOfMeasures, DoNotChangeALoop) {
  for (const char* method : {"verlet", "rk4", "gauss"}) {
    const MeasuredTable in_ones = table_of("poincare-loop", sprung<0, 0>(method)),
                        strange = table_of("poincare-loop", sprung<30, 100>(method));
    ASSERT_EQ(strange.lines.size(), in_ones.lines.size()) << method << strange.ended;
    ASSERT_GT(in_ones.lines.size(), 10U);
    for (std::size_t k = 0; k < in_ones.lines.size(); ++k)
      EXPECT_EQ(number(strange.lines[k], 0), number(in_ones.lines[k], 0)) << method << k;
  }
}

}  // namespace
}  // namespace pfaff
