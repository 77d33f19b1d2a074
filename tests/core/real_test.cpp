// Real: exact decimals and fractions, before they are rounded to a precision.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <type_traits>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/real.hpp>

namespace {
using namespace pfaff;

Quad quad(const char* text) {
  Quad x;
  EXPECT_TRUE(parse(text, x)) << text;
  return x;
}

TEST(Real, DecimalsAreTheNearestNumberInEveryPrecision) {
  const struct {
    const char* text;
    double nearest;
  } cases[] = {{"0.1", 0.1},
               {"0.3", 0.3},
               {"-2.5e-3", -2.5e-3},
               {"1e22", 1e22},
               {"1.7976931348623157e308", 1.7976931348623157e308},
               {"123456789.987654321", 123456789.987654321},
               {"+4.9e-324", 4.9e-324},
               {"-0", -0.0},
               {".5", .5},
               {"5.", 5.}};
  for (const auto& c : cases) {
    const auto real = Real::parse(c.text);
    ASSERT_TRUE(real) << c.text;
    EXPECT_EQ(real->value(), c.nearest) << c.text;
    EXPECT_EQ(real->quad(), quad(c.text)) << c.text;
  }
  EXPECT_EQ((0.1_r).value(), 0.1);
  // Control: the double 0.1 is not the decimal.
  EXPECT_NE((0.1_r).quad(), Quad(0.1));
}

TEST(Real, TheDoubleIsRoundedFromTheTextNotFromItsQuad) {
  // Above the middle of 1 and the next double by less than quad resolves: rounding twice gives 1.
  const char* text = "1.00000000000000011102230246251565404236316680908203125000000000000000001";
  const auto real = Real::parse(text);
  ASSERT_TRUE(real);
  EXPECT_EQ(real->value(), 1 + std::numeric_limits<double>::epsilon());
  EXPECT_EQ(static_cast<double>(real->quad()), 1.0);  // control: the trap is there
}

TEST(Real, DecimalsAndQuotientsAreFractionsInLowestTerms) {
  const auto expect = [](const char* text, std::int64_t numerator, std::int64_t denominator) {
    const auto real = Real::parse(text);
    ASSERT_TRUE(real) << text;
    EXPECT_TRUE(real->is_fraction()) << text;
    EXPECT_EQ(real->numerator(), numerator) << text;
    EXPECT_EQ(real->denominator(), denominator) << text;
  };
  expect("0.3", 3, 10);
  expect("2/3", 2, 3);
  expect("-4/6", -2, 3);
  expect("1/-2", -1, 2);
  expect("0.5/1.5", 1, 3);
  expect("1e3", 1000, 1);
  expect("1.5e-3", 3, 2000);
  expect("0/7", 0, 1);
  EXPECT_FALSE(Real::parse("1e-30")->is_fraction());
  EXPECT_FALSE(Real::parse("3.14159265358979323846264338327950288")->is_fraction());
}

TEST(Real, ArithmeticOnFractionsStaysExact) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> number(-999, 999), positive(1, 999);
  for (int k = 0; k < 200; ++k) {
    const std::int64_t a = number(random), b = positive(random), c = number(random), d = positive(random);
    const Real x = Real::fraction(a, b), y = Real::fraction(c, d);
    const auto is = [](const Real& r, std::int64_t numerator, std::int64_t denominator) {
      return r.is_fraction() && r.numerator() * denominator == numerator * r.denominator();
    };
    EXPECT_TRUE(is(x + y, a * d + c * b, b * d));
    EXPECT_TRUE(is(x - y, a * d - c * b, b * d));
    EXPECT_TRUE(is(x * y, a * c, b * d));
    EXPECT_TRUE(is(-x, -a, b));
    if (c != 0) {
      EXPECT_TRUE(is(x / y, a * d, b * c));
      EXPECT_TRUE(x / y * y == x);
      EXPECT_EQ((x / y * y).denominator(), x.denominator());
    }
  }
  EXPECT_TRUE((1_r / 3_r + 2_r / 3_r).is(1));
  EXPECT_EQ((0.1_r + 0.2_r).value(), 0.3);
  EXPECT_NE(0.1 + 0.2, 0.3);  // control
}

TEST(Real, FractionsThatDoNotFitBecomeQuads) {
  const Real large = Real::fraction(std::int64_t{3037000507}, 1);  // its square is above 2^62
  Real power = large;
  for (int k = 0; k < 3; ++k) {
    power = power * large;
    EXPECT_FALSE(power.is_fraction());
  }
  const Quad expected = Quad(3037000507.0) * Quad(3037000507.0) * Quad(3037000507.0) * Quad(3037000507.0);
  EXPECT_LE(abs(power.quad() / expected - Quad(1)), Quad(4e-34));  // a few roundings
  const Real tiny = 1 / large;
  EXPECT_TRUE(tiny.is_fraction());
  EXPECT_FALSE((tiny * tiny * tiny).is_fraction());
  // Sums of nearly full fractions must not overflow on the way.
  const std::int64_t most = std::numeric_limits<std::int64_t>::max() / 2;
  const Real sum = Real::fraction(most, most - 1) + Real::fraction(most, most - 2);
  EXPECT_FALSE(sum.is_fraction());
  EXPECT_LE(abs(sum.quad() - Quad(2)), Quad(1e-17));
}

TEST(Real, FunctionsAreQuadsExceptAtSmallIntegers) {
  EXPECT_TRUE(sqrt(Real(4)).is_fraction());
  EXPECT_TRUE(sqrt(Real(4)).is(2));
  EXPECT_TRUE(exp(Real(0)).is(1));
  EXPECT_TRUE(sin(Real(0)).is(0));
  EXPECT_TRUE(cos(Real(0)).is(1));
  EXPECT_TRUE(log(Real(1)).is(0));
  EXPECT_TRUE(pow(Real(2), Real(10)).is(1024));
  EXPECT_FALSE(sqrt(Real(2)).is_fraction());
  EXPECT_EQ(sqrt(Real(2)).quad(), sqrt(Quad(2)));
  EXPECT_EQ(exp(0.3_r).quad(), exp((0.3_r).quad()));
}

TEST(Real, ParseRefusesWhatIsNotANumber) {
  for (const char* text :
       {"",    "1e",    "0x1",  "1/0",     "nan",      " 1",    "1 ",    "inf",  "-",     "+",
        ".",   "1.2.3", "--1",  "1/",      "/2",       "1/2/3", "1//2",  "e5",   "1e5.5", "1,5",
        "one", "1/0.0", "1/ 2", "1e99999", "-1e99999", "0.5e-", "1_000", "1e+-5"})
    EXPECT_FALSE(Real::parse(text)) << "'" << text << "'";
  EXPECT_TRUE(Real::parse("1.5e-2147483648"));  // an exponent at the edge of int underflows to zero
  EXPECT_TRUE(Real::parse("1.5e-2147483648")->is(0));
}

TEST(Real, TextIsShortAndNamesTheConstant) {
  EXPECT_EQ(to_string(0.3_r), "0.3");
  EXPECT_EQ(to_string(Real::fraction(1, 3)), "1/3");
  EXPECT_EQ(to_string(Real(-7)), "-7");
  EXPECT_EQ(to_string(Real::fraction(1, 8)), "0.125");
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-40, 40);
  std::uniform_int_distribution<std::int64_t> whole(1, std::int64_t{1} << 40);
  for (int k = 0; k < 300; ++k) {
    const Real binary{Quad(mantissa(random)) * exp(Quad(exponent(random)))};
    const Real fraction = Real::fraction(whole(random) - (std::int64_t{1} << 39), whole(random));
    for (const Real& real : {binary, fraction}) {
      const auto back = Real::parse(to_string(real));
      ASSERT_TRUE(back) << to_string(real);
      EXPECT_EQ(back->quad(), real.quad()) << to_string(real);
      EXPECT_EQ(back->value(), real.value()) << to_string(real);
      EXPECT_TRUE(!real.is_fraction() || back->numerator() == real.numerator());
    }
  }
}

TEST(Real, TextIsWrittenAsAPersonWritesIt) {
  for (const char* text : {"0",
                           "1",
                           "10",
                           "-10",
                           "100",
                           "10000",
                           "1000000",
                           "1250000",
                           "123456789",
                           "12345678901234567",
                           "0.3",
                           "-0.3",
                           "0.05",
                           "0.0005",
                           "12.5",
                           "1234.5678",
                           "0.1234567890123456",
                           "1e-12",
                           "1e-5",
                           "-2.5e-6",
                           "1e22",
                           "1e9",
                           "1.5e300",
                           "1/3",
                           "-22/7",
                           "0.12345678901234567890123456789",
                           "3.1415926535897932384626433832795028"}) {
    const auto real = Real::parse(text);
    ASSERT_TRUE(real) << text;
    EXPECT_EQ(to_string(*real), text);
  }
  EXPECT_EQ(to_string(*Real::parse("1e1")), "10");
  EXPECT_EQ(to_string(*Real::parse("1.50")), "1.5");
  EXPECT_EQ(to_string(*Real::parse("0.00001")), "1e-5");
  EXPECT_EQ(to_string(Real::fraction(1, 1000)), "0.001");
}

TEST(Real, FormulasTakeTheScalarOfTheirVariables) {
  EXPECT_EQ(0.1_r * 3.0, 0.1 * 3.0);
  EXPECT_EQ(0.1_r * Quad(3), quad("0.1") * Quad(3));
  EXPECT_EQ(1 / 0.1_r, Real(10));
  // A double would be cut to an int if it converted.
  static_assert(!std::is_constructible_v<Real, double> && !std::is_convertible_v<double, Real>);
  static_assert(!std::is_constructible_v<Real, float>);
  static_assert(std::is_convertible_v<int, Real> && std::is_constructible_v<Real, Quad>);
}

}  // namespace
