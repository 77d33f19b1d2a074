// Exact rationals, alone and under the project's linear algebra.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace {
using namespace pfaff;

Rational fraction(int numerator, int denominator) { return Rational(Real::fraction(numerator, denominator)); }

TEST(Rational, IsMadeExactly) {
  EXPECT_EQ(to_string(Rational(0.3_r)), "3/10");
  EXPECT_EQ(to_string(Rational(-4)), "-4");
  EXPECT_EQ(fraction(6, 4), fraction(3, 2));
  EXPECT_EQ(0.5_r * Rational(3), fraction(3, 2));
  // A double is a binary number, not the decimal it was written as.
  EXPECT_EQ(Rational(0.375), fraction(3, 8));
  EXPECT_NE(Rational(0.3), fraction(3, 10));
  EXPECT_THROW(Rational(double(NAN)), std::domain_error);
  EXPECT_THROW(Rational(double(INFINITY)), std::domain_error);
  EXPECT_THROW(Rational(Quad(1) / Quad(0)), std::domain_error);
  EXPECT_THROW(Rational(sqrt(Real(2))), std::domain_error);
}

TEST(Rational, ConvertsToTheNearestNumber) {
  std::mt19937_64 random(71);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 1000; ++trial) {
    const double x = std::ldexp(number(random), static_cast<int>(random() % 200) - 100);
    EXPECT_EQ(static_cast<double>(Rational(x)), x);
    const Quad y = Quad(x) / Quad(3);
    EXPECT_EQ(static_cast<Quad>(Rational(y)), y);
  }
  EXPECT_EQ(static_cast<double>(fraction(1, 3)), 1.0 / 3);
  EXPECT_EQ(static_cast<Quad>(fraction(-1, 3)), Quad(-1) / Quad(3));
}

TEST(Rational, IsOrderedAndSelects) {
  EXPECT_LT(fraction(1, 3), fraction(1, 2));
  EXPECT_GE(fraction(1, 3), fraction(2, 6));
  EXPECT_EQ(abs(fraction(-1, 3)), fraction(1, 3));
  EXPECT_EQ(select(fraction(1, 9), Rational(1), Rational(2)), Rational(1));
  EXPECT_EQ(select(Rational(0), Rational(1), Rational(2)), Rational(2));
  EXPECT_TRUE(isfinite(Rational(1)));
  EXPECT_FALSE(isnan(Rational(1)));
  EXPECT_FALSE(structurally_zero(Rational(0)));
  EXPECT_EQ(unit_roundoff<Rational>(), Rational(0));
}

TEST(Rational, HasPowersOnlyWhereTheyAreFractions) {
  EXPECT_EQ(pow(fraction(2, 3), Real(3)), fraction(8, 27));
  EXPECT_EQ(pow(fraction(2, 3), Real(-2)), fraction(9, 4));
  EXPECT_EQ(pow(fraction(2, 3), Real(0)), Rational(1));
  EXPECT_THROW(pow(fraction(4, 9), 0.5_r), std::domain_error);
  EXPECT_THROW(Rational(1) / Rational(0), std::overflow_error);
}

// Derivatives of rational functions are exact: ((x^2 + 1) / (x - 2))' at x = 1/3.
TEST(Rational, CarriesDerivatives) {
  using D = Dual<Rational, 1>;
  const D x = D::variable(fraction(1, 3), 0), y = (x * x + 1) / (x - 2);
  EXPECT_EQ(y.value, fraction(-2, 3));
  EXPECT_EQ(y.derivative[0], fraction(-4, 5));
}

TEST(Rational, MatricesAreExact) {
  // Hilbert matrices: the inverse has integer entries, the determinant of size 6 is 1 / 186313420339200000.
  const std::size_t n = 6;
  Matrix<Rational> hilbert(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) hilbert(i, j) = fraction(1, static_cast<int>(i + j + 1));
  EXPECT_EQ(to_string(determinant(hilbert)), "1/186313420339200000");
  const Matrix<Rational> unit = inverse(hilbert) * hilbert;
  EXPECT_EQ(largest(unit - Matrix<Rational>::identity(n)), Rational(0));
  EXPECT_EQ(inverse(hilbert)(0, 0), Rational(36));
  EXPECT_EQ(inverse(hilbert)(5, 5), Rational(698544));
  LU<Rational> lu(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) lu(i, j) = hilbert(std::min<std::size_t>(i, 4), j);
  EXPECT_FALSE(lu.factor());
  // A singular matrix has no inverse to give: there is no rational that is not a number.
  EXPECT_THROW(inverse(Matrix<Rational>(2, 2)), std::domain_error);
  EXPECT_EQ(determinant(Matrix<Rational>(2, 2)), Rational(0));
}

}  // namespace
