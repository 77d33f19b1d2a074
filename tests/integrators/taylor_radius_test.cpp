// Taylor's method with a tolerance on motions whose coefficients vanish in most degrees: its steps stay
// within the radius of convergence. The values are those of integrals in 40 digits, and of the sine
// lemniscate.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>

#include "adaptive_samples.hpp"
#include "methods.hpp"

namespace pfaff {
namespace {

using testing::method_named;
using testing::sample_of;

// q'' = -factor q^{exponent - 1}, for which q = t + O(t^{exponent + 1}) from (0, 1).
template <int exponent, int factor>
struct Stiffening {
  static constexpr int dimension = 2;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    T force(factor);
    for (int k = 1; k < exponent; ++k) force = force * z[0];
    rate[0] = z[1];
    rate[1] = -force;
  }
};
struct Moving {  // a free particle in three dimensions
  static constexpr int dimension = 6;
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    for (std::size_t k = 0; k < 3; ++k) rate[k] = z[3 + k], rate[3 + k] = T(0);
  }
};

// The position at the end, and how many steps there were.
template <class T, class S>
Quad position(S system, int momentum, int time, double tolerance, std::int64_t& steps) {
  const auto stepper = method_named("taylor")->stepper(sample_of(system, {0, momentum}), T());
  std::vector<T> z{T(0), T(momentum)};
  T t(0);
  EXPECT_EQ(stepper->advance_to(t, T(time), T(tolerance), z), Status::converged);
  steps = stepper->counters().steps;
  return Quad(z[0]);
}
// Errors of the steps add up, and the phase of an oscillator is carried on: with `growth` of them at most.
template <class T, class S>
void expect_position(S system, int momentum, int time, std::initializer_list<double> tolerances,
                     const char* expected, double growth) {
  for (const double tolerance : tolerances) {
    std::int64_t steps = 0;
    const Quad found = position<T>(system, momentum, time, tolerance, steps);
    EXPECT_LE(static_cast<double>(abs(found - Real::parse(expected)->quad())), growth * tolerance)
        << tolerance;
    EXPECT_LE(steps, 200 * time) << tolerance;
  }
}

TEST(TaylorRadius, LemniscateOscillator) {
  const char* const expected = "0.361193780021377981261763648476976105254895";
  expect_position<double>(Stiffening<4, 2>{}, 1, 100, {1e-6, 1e-9, 1e-12}, expected, 2000);
  expect_position<Quad>(Stiffening<4, 2>{}, 1, 100, {1e-12, 1e-19, 1e-28}, expected, 2000);
}
TEST(TaylorRadius, LongerGaps) {
  expect_position<double>(Stiffening<6, 3>{}, 1, 2, {1e-8, 1e-12},
                          "0.428460829879984263594233231522481584851935", 100);
  expect_position<double>(Stiffening<8, 1>{}, 2, 2, {1e-8, 1e-12},
                          "-0.7087063569452047804509721054731466485559939", 1000);
  expect_position<double>(Stiffening<30, 1>{}, 2, 2, {1e-8, 1e-12},
                          "-0.7933962274318839137981456439810429408424069", 1000);
  expect_position<Quad>(Stiffening<30, 1>{}, 2, 2, {1e-19}, "-0.7933962274318839137981456439810429408424069",
                        1000);
}
// Control: a polynomial has no radius, and one step goes all the way, in any dimension and in quad.
TEST(TaylorRadius, PolynomialsHaveNone) {
  const auto stepper = method_named("taylor")->stepper(sample_of(Moving{}, {0, 0, 0, 1, 2, 3}), Quad());
  std::vector<Quad> z{Quad(0), Quad(0), Quad(0), Quad(1), Quad(2), Quad(3)};
  Quad t(0);
  EXPECT_EQ(stepper->advance_to(t, Quad(-1000000), Quad(1e-28), z), Status::converged);
  EXPECT_EQ(stepper->counters().steps, 1);
  EXPECT_TRUE(z[2] == Quad(-3000000));
}

}  // namespace
}  // namespace pfaff
