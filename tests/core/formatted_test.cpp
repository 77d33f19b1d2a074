// Numbers as text are the same whatever the locale is, in C and in C++. A locale with a decimal comma is the
// control: printf and streams follow it.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdio>
#include <locale>
#include <sstream>

#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/numbers/real.hpp>

#include "../comma_locale.hpp"

namespace {
using namespace pfaff;

class Commas : public std::numpunct<char> {
 protected:
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

// Both kinds of locale, until the end of the test.
class Formatted : public ::testing::Test {
 protected:
  Formatted() {
    std::locale::global(std::locale(std::locale::classic(), new Commas));
    EXPECT_NE(std::setlocale(LC_NUMERIC, "comma"), nullptr);
  }
  ~Formatted() override {
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, "C");
  }

 private:
  pfaff::testing::CommaLocale comma_;
};

std::string by_printf(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

TEST_F(Formatted, IsWhatPrintfPrintsInTheClassicLocale) {
  EXPECT_EQ(by_printf(0.54), "0,54") << "the control: there is no locale with a comma";
  EXPECT_EQ(formatted("%.3g", 0.54), "0.54");
  EXPECT_EQ(formatted("%+.1e|%5s|%d|%.2f", -1234.5, "ab", 7, 1e6), "-1.2e+03|   ab|7|1000000.00");
  EXPECT_EQ(formatted("%s", std::string(500, 'x').c_str()), std::string(500, 'x'));
  EXPECT_EQ(formatted("%.17g", 0.1), "0.10000000000000001");
  EXPECT_EQ(by_printf(0.54), "0,54") << "the locale of the thread is put back";
}

TEST_F(Formatted, QuadsAreReadAndWrittenAsEver) {
  Quad x;
  EXPECT_TRUE(parse("-2.5e-3", x));
  EXPECT_TRUE(x == Quad(-1) / Quad(400));
  EXPECT_FALSE(parse("2,5", x));
  EXPECT_EQ(to_string(Quad(1) / Quad(8), 17), "0.125");
  EXPECT_EQ(to_scientific(Quad(1) / Quad(3), 5), "3.3333e-01");
}

TEST_F(Formatted, ConstantsTooBothInDoubleAndInQuad) {
  const auto x = Real::parse("0.3");
  ASSERT_TRUE(x.has_value());
  EXPECT_EQ(x->value(), 0.3);
  EXPECT_EQ(to_string(*x), "0.3");
  EXPECT_EQ(to_string(Real(1) / Real(3)), "1/3");
  EXPECT_FALSE(Real::parse("0,3").has_value());
}

TEST_F(Formatted, StreamsOfOurs) {
  std::ostringstream theirs;
  theirs << 1234567;
  EXPECT_EQ(theirs.str(), "1.234.567") << "the control: streams do not follow the locale";
  TextStream ours;
  ours << 1234567;
  EXPECT_EQ(ours.str(), "1234567");
}

}  // namespace
