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

// A stiff spring of frequency 1e5 on a soft one: in units in which both count alike a step of Gauss shows
// what it rounds, which is not said to be its structure.
struct StiffSpring {
  static constexpr int dimension = 4;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return T(Real(1000000) * Real(10000)) * q[0] * q[0] / 2 + q[1] * q[1] * q[1] * q[1] / 4 +
           q[0] * q[1] * q[1];
  }
};

TEST(UnitsOfMeasures, RoundingOfStiffStepsIsNoLossOfStructure) {
  static const System<StiffSpring> plugin{
      {.name = "stiff-spring", .title = "", .reference = "", .initial = {1_r / 1000, 1, 0, 0}}};
  const ToMeasure run{integrate(plugin.make({}), integrators().get("gauss", "").make({}), 0.0641025641026),
                      100};
  EXPECT_LT(largest(table_of("structure", run)), 1e5 * 0x1p-53);
}

// The particle runs off to infinity at t = 0.77; what it does later says nothing of the size of a loop.
struct RunningOff {
  static constexpr int dimension = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -(q[0] * q[0] * q[0] * q[0] / 4);
  }
};

TEST(UnitsOfMeasures, ALoopHasTheSizeOfTheStart) {
  static const System<RunningOff> plugin{
      {.name = "running-off", .title = "", .reference = "", .initial = {1, 1}}};
  const ToMeasure run{integrate(plugin.make({}), integrators().get("rk4", "").make({}), 0.01), 1000};
  const MeasuredTable table = table_of("poincare-loop(looks=1000)", run);
  ASSERT_GT(table.lines.size(), 40U);
  EXPECT_NEAR(number(table.lines[40], 0), 1, 1e-3);
  EXPECT_LT(number(table.lines[40], 1), 1e-9);
  EXPECT_NE(table.ended, "");
}

// Scales are powers of two: every point of the loop is the same to the last bit. No mass is 1, of which
// gauss makes equations of its own.
TEST(UnitsOfMeasures, DoNotChangeALoop) {
  for (const char* method : {"verlet", "rk4", "gauss"}) {
    const MeasuredTable plain = table_of("poincare-loop", sprung<20, 60>(method)),
                        strange = table_of("poincare-loop", sprung<30, 100>(method));
    ASSERT_EQ(strange.lines.size(), plain.lines.size()) << method << strange.ended;
    ASSERT_GT(plain.lines.size(), 10U);
    for (std::size_t k = 0; k < plain.lines.size(); ++k)
      EXPECT_EQ(number(strange.lines[k], 0), number(plain.lines[k], 0)) << method << k;
  }
}

}  // namespace
}  // namespace pfaff
