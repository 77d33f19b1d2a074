// Decimal digits made of integers are the texts of printf, for numbers of every size.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <pfaff/bench/runner/decimal_text.hpp>
#include <pfaff/core/numbers/formatted.hpp>

namespace {
using namespace pfaff;

template <class T>
std::string text_by_integers(const T& x) {
  std::array<char, longest_decimal> text{};
  return {text.data(), put_decimal(text.data(), x)};
}
void expect_the_text_of_printf(double x) { ASSERT_EQ(text_by_integers(x), formatted("%.17g", x)); }
void expect_the_text_of_quadmath(const Quad& x) { ASSERT_EQ(text_by_integers(x), to_string(x, 36)); }

TEST(DecimalText, OfAnyDouble) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 200000; ++k) expect_the_text_of_printf(std::bit_cast<double>(random()));
  for (int k = 0; k < 20000; ++k) {
    expect_the_text_of_printf(0.02 * k);
    expect_the_text_of_printf(-k / 8.0);  // whose digits end
  }
}

// Where a digit more or less stands before the point, where the last digit is rounded up through all others,
// and at the ends of the range.
TEST(DecimalText, AroundPowersOfTenAndTwo) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (int e = -324; e <= 308; ++e) {
    const double power = std::pow(10.0, e);
    for (const double x : {power, std::nextafter(power, 0), std::nextafter(power, infinity)})
      expect_the_text_of_printf(x);
  }
  for (int e = -1074; e < 1024; ++e)
    for (const double towards : {0.0, infinity})
      expect_the_text_of_printf(std::nextafter(std::ldexp(1.0, e), towards));
  for (const double x : {0.0, -0.0, infinity, -infinity, 9007199254740993.0, 0.5, 123456789012345678.0})
    expect_the_text_of_printf(x);
}

TEST(DecimalText, OfQuads) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 20000; ++k) {
    const Quad x =
        Quad(normal(random)) + Quad(normal(random)) * Quad(0x1p-53) + Quad(normal(random)) * Quad(0x1p-106);
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000);
    for (const Quad& y : {x, x * Quad(scale), x * Quad(scale) * Quad(scale), Quad(double(k)) / Quad(50)})
      expect_the_text_of_quadmath(y);
  }
  Quad power(1);
  for (int k = 0; k < 400; ++k, power = power * Quad(10))
    for (const Quad& x : {power, Quad(1) / power, power * (Quad(1) - Quad(0x1p-113)), -power})
      expect_the_text_of_quadmath(x);
  expect_the_text_of_quadmath(Quad(0));
  expect_the_text_of_quadmath(-Quad(0));
}

}  // namespace
