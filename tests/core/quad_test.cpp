// Quad: binary128 arithmetic and libquadmath's functions behind a value type.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include <pfaff/core/numbers/functions.hpp>

#include "relative_error.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::relative_error;

// libquadmath promises a unit or two in the last place, 2e-34; an identity combines a few.
constexpr double few_units = 1e-33;

TEST(Quad, KeepsWhatADoubleLoses) {
  const Quad third = Quad(1) / Quad(3), small(0x1p-100);
  EXPECT_EQ(third * Quad(3), Quad(1));
  EXPECT_NE(third, Quad(1.0 / 3.0));
  EXPECT_EQ(Quad(1) + small - Quad(1), small);
  EXPECT_EQ(1 + 0x1p-100 - 1, 0);  // control
  EXPECT_EQ(Quad(1) + std::numeric_limits<Quad>::epsilon() / Quad(2), Quad(1));
  EXPECT_GT(Quad(1) + std::numeric_limits<Quad>::epsilon(), Quad(1));
  EXPECT_EQ(unit_roundoff<Quad>(), Quad(0x1p-113));
  EXPECT_EQ(unit_roundoff<double>(), 0x1p-53);
}

TEST(Quad, FunctionsSatisfyTheirIdentities) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-3, 3), positive(0.01, 10);
  double worst_rounded = 0;
  for (int k = 0; k < 300; ++k) {
    const Quad x = Quad(any(random)) / Quad(3), y = Quad(any(random)) / Quad(7);
    const Quad u = Quad(positive(random)) / Quad(3);
    EXPECT_LE(relative_error(sin(x) * sin(x) + cos(x) * cos(x), Quad(1)), few_units);
    EXPECT_LE(relative_error(sin(x + y), sin(x) * cos(y) + cos(x) * sin(y)), few_units);
    EXPECT_LE(relative_error(cos(x - y), cos(x) * cos(y) + sin(x) * sin(y)), few_units);
    EXPECT_LE(relative_error(exp(x + y), exp(x) * exp(y)), few_units);
    EXPECT_LE(relative_error(exp(log(u)), u), few_units);
    EXPECT_LE(relative_error(sqrt(u) * sqrt(u), u), few_units);
    EXPECT_LE(relative_error(pow(u, y), exp(y * log(u))), few_units);
    EXPECT_LE(relative_error(pow(u, Real(3)), u * u * u), few_units);
    EXPECT_LE(relative_error(pow(u, Real::fraction(-1, 2)), Quad(1) / sqrt(u)), few_units);
    Quad s, c;
    sine_cosine(x, s, c);
    EXPECT_LE(relative_error(s, sin(x)), few_units);
    EXPECT_LE(relative_error(c, cos(x)), few_units);
    worst_rounded = std::max(worst_rounded, relative_error(exp(Quad(static_cast<double>(x))), exp(x)));
  }
  EXPECT_GT(worst_rounded, 1e-17);  // control: arguments rounded to double fail the bound by far
}

TEST(Quad, AgreesWithPublishedDigits) {
  Quad pi, e, root;
  ASSERT_TRUE(parse("3.14159265358979323846264338327950288419716939937510", pi));
  ASSERT_TRUE(parse("2.71828182845904523536028747135266249775724709369995", e));
  ASSERT_TRUE(parse("1.41421356237309504880168872420969807856967187537694", root));
  EXPECT_LE(abs(sin(pi)), Quad(1e-34));  // the rounding of pi itself
  EXPECT_LE(relative_error(cos(pi), Quad(-1)), few_units);
  EXPECT_LE(relative_error(exp(Quad(1)), e), few_units);
  EXPECT_LE(relative_error(sqrt(Quad(2)), root), few_units);
  EXPECT_EQ(to_string(root, 20), "1.4142135623730950488");
}

TEST(Quad, TextOf36DigitsIdentifiesANumber) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-8000, 8000);
  int lost = 0;
  for (int k = 0; k < 1000; ++k) {
    const Quad x =
        (Quad(mantissa(random)) + Quad(mantissa(random)) * Quad(0x1p-53)) * exp(Quad(exponent(random)));
    Quad back;
    ASSERT_TRUE(parse(to_string(x), back));
    EXPECT_EQ(back, x) << to_string(x);
    ASSERT_TRUE(parse(to_string(x, 33), back));
    lost += back == x ? 0 : 1;
  }
  EXPECT_GT(lost, 100);  // control: 33 digits do not
}

TEST(Quad, ParseTakesTheWholeTextOrNothing) {
  Quad x(7);
  for (const char* text : {"", "1e", "1x", "1 ", " 1", "\n1", "--1", "one", "1.2.3"}) {
    EXPECT_FALSE(parse(text, x)) << "'" << text << "'";
    EXPECT_EQ(x, Quad(7));
  }
  EXPECT_FALSE(parse(std::string_view("1\0z", 3), x));
  EXPECT_TRUE(parse("-1.25e-3", x));
  EXPECT_EQ(static_cast<double>(x), -0.00125);
}

TEST(Quad, NonFiniteNumbersAreSeen) {
  const Quad infinity = std::numeric_limits<Quad>::infinity(), nan = std::numeric_limits<Quad>::quiet_NaN();
  EXPECT_TRUE(isfinite(Quad(1e300) * Quad(1e300)));
  EXPECT_FALSE(isfinite(infinity));
  EXPECT_FALSE(isfinite(-infinity));
  EXPECT_FALSE(isfinite(nan));
  EXPECT_FALSE(isnan(infinity));
  EXPECT_TRUE(isnan(nan));
  EXPECT_TRUE(isnan(infinity - infinity));
  EXPECT_TRUE(isnan(log(Quad(-1))));
  EXPECT_TRUE(isnan(sqrt(Quad(-1))));
  EXPECT_EQ(Quad(1) / Quad(0), infinity);
  EXPECT_EQ(exp(Quad(20000)), infinity);
  EXPECT_FALSE(nan == nan);
  EXPECT_FALSE(nan < Quad(0));
  EXPECT_EQ(abs(-infinity), infinity);
  for (const Quad x : {infinity, -infinity}) {
    Quad back;
    EXPECT_TRUE(parse(to_string(x), back));
    EXPECT_EQ(back, x);
  }
}

TEST(Quad, SelectTakesTheFirstBranchAboveZeroOnly) {
  EXPECT_EQ(select(Quad(1e-300), Quad(1), Quad(2)), Quad(1));
  EXPECT_EQ(select(Quad(0), Quad(1), Quad(2)), Quad(2));
  EXPECT_EQ(select(std::numeric_limits<Quad>::quiet_NaN(), Quad(1), Quad(2)), Quad(2));
  EXPECT_EQ(select(-0.0, 1.0, 2.0), 2.0);
}

}  // namespace
