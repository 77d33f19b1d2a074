// Secants: corrections of an iteration with a fixed matrix, improved by what earlier ones have shown.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/integrators/support/secant_updates.hpp>

namespace {
using namespace pfaff;
using D = Dual<double, 1>;

// x = g(x) with a contraction that turns and bends, x measured in other units. The residual is the correction
// of the plain iteration.
template <class T>
Vector<T, dynamic> plain_correction(const Vector<T, dynamic>& x, const T& parameter, double unit) {
  const T a = x[0], b = x[1] / T(unit);
  return {parameter + T(0.3) * a - T(0.2) * b + T(0.05) * a * b - a,
          (T(1) + T(0.25) * a + T(0.1) * b * b - b) * T(unit)};
}

// The solution, and the number of corrections until the last is below 1e-15.
template <class T>
struct Solution {
  Vector<T, dynamic> x;
  int corrections = 0;
};
template <class T>
Solution<T> secant_solution(const T& parameter, bool secants, double unit = 1) {
  SecantUpdates<T> updates(2);
  Solution<T> s{{T(0.8), T(1.2 * unit)}, 0};
  const Vector<T, dynamic> scale{T(1), T(unit)};
  for (double size = 1; size > 1e-15 && s.corrections < 100; ++s.corrections) {
    Vector<T, dynamic> correction = plain_correction(s.x, parameter, unit);
    if (secants) updates.improve(correction, scale, scale);
    size = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      s.x[k] = s.x[k] + correction[k];
      size = std::max(size, std::abs(value_of(correction[k])) / value_of(scale[k]));
    }
  }
  return s;
}

TEST(SecantUpdates, MakeCorrectionsSmallerFasterThanAFixedRatio) {
  const auto with = secant_solution(1.0, true), plain = secant_solution(1.0, false);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(with.x[k], plain.x[k], 1e-14);
  EXPECT_GE(plain.corrections, 25);  // the control: a ratio of about 0.3
  EXPECT_LE(with.corrections, 10);
}

TEST(SecantUpdates, DoNotDependOnUnits) {
  const auto one = secant_solution(1.0, true);
  for (const double unit : {0x1p100, 0x1p-600}) {  // the square of 1 / unit is no number in double
    const auto other = secant_solution(1.0, true, unit);
    EXPECT_EQ(one.corrections, other.corrections);
    EXPECT_EQ(one.x[0], other.x[0]);
    EXPECT_EQ(one.x[1], other.x[1] / unit);
  }
}

TEST(SecantUpdates, CorrectDerivativesWithTheSameMatrices) {
  const auto x = secant_solution(D::variable(1.0, 0), true).x;
  const double h = 1e-6;  // its square and round-off over it are what the difference quotient misses
  const auto above = secant_solution(1.0 + h, true).x, below = secant_solution(1.0 - h, true).x;
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_NEAR(x[k].derivative[0], (above[k] - below[k]) / (2 * h), 1e-8) << k;
}

// Where the values have converged their corrections are rounding errors. What these are must not change what
// is made of the derivatives.
TEST(SecantUpdates, LearnNothingFromRoundOff) {
  const auto derivatives_after = [](Vector<double, dynamic> roundings) {
    SecantUpdates<D> updates(2);
    const Vector<D, dynamic> scale{D(1), D(1)};
    for (const double x : {1e-2, 1e-4}) {
      Vector<D, dynamic> correction{D::variable(x, 0), D(-x / 2)};
      updates.improve(correction, scale, scale);
    }
    Vector<double, dynamic> made;
    for (const double rounding : roundings) {
      Vector<D, dynamic> correction{D::variable(rounding, 0), D(-rounding)};
      updates.improve(correction, scale, scale);
      made.push_back(correction[0].derivative[0]);
      made.push_back(correction[1].derivative[0]);
    }
    return made;
  };
  EXPECT_EQ(derivatives_after({1e-16, 2e-16, -1e-16}), derivatives_after({-3e-16, -2.9e-16, 1e-15}));
  // The control: corrections that are more than that do change it.
  EXPECT_NE(derivatives_after({1e-7, 2e-8, -1e-8}), derivatives_after({-3e-7, 2e-8, 1e-9}));
}

TEST(SecantUpdates, StartAnewOnceForgotten) {
  SecantUpdates<double> used(2), fresh(2);
  const Vector<double, dynamic> scale{1, 1};
  for (const double x : {1.0, 0.5, 0.1}) {
    Vector<double, dynamic> correction{x, x * x};
    used.improve(correction, scale, scale);
  }
  used.forget();
  for (const double x : {0.3, 0.2}) {
    Vector<double, dynamic> a{x, 1 - x}, b = a;
    used.improve(a, scale, scale);
    fresh.improve(b, scale, scale);
    EXPECT_EQ(a, b);
  }
}

}  // namespace
