// Expressions as text: values against the same arithmetic written in C++, exactness of constants, errors with
// their places, and bounds on what a text can ask for.
#include <gtest/gtest.h>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/text/scope.hpp>

namespace {
using namespace pfaff;
using namespace pfaff::text;

Source source(const std::string& written) { return {written, "model.toml", 7, 12}; }
Real value(const std::string& written) { return constant(source(written)); }
void expect_fraction(const std::string& written, std::int64_t numerator, std::int64_t denominator) {
  const Real x = value(written);
  EXPECT_TRUE(x.is_fraction()) << written;
  EXPECT_EQ(x.numerator(), numerator) << written;
  EXPECT_EQ(x.denominator(), denominator) << written;
}

// The message of the error that a text makes, and what it shows.
std::string message(const std::string& written, Scope scope = {}) {
  try {
    (void)scope.evaluate(Expression(source(written)));
  } catch (const TextError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return std::string(error.what()) + "\n" + error.excerpt();
  }
  return "no error";
}
void expect_error(const std::string& written, const std::string& part, const Scope& scope = {}) {
  EXPECT_NE(message(written, scope).find(part), std::string::npos) << written << "\n"
                                                                   << message(written, scope);
}

TEST(TextExpression, ConstantsFoldExactly) {
  expect_fraction("0.1", 1, 10);
  expect_fraction("1/3 + 1/6", 1, 2);
  expect_fraction("2 - 3 - 4", -5, 1);  // from the left
  expect_fraction("12/2/3", 2, 1);      // from the left
  expect_fraction("2*3/4*5", 15, 2);
  expect_fraction("-2^2", -4, 1);  // the power binds first
  expect_fraction("2^-2", 1, 4);
  expect_fraction("2^3^2", 512, 1);  // from the right
  expect_fraction("(-2/3)^3", -8, 27);
  expect_fraction("pow(2/3, 4)", 16, 81);
  expect_fraction("- -+3", 3, 1);
  expect_fraction(" 1.25e-2\n * 8 ", 1, 10);
  expect_fraction("sqrt(4) + cos(0) + exp(0) + log(1) + sin(0) + tan(0)", 4, 1);
  expect_fraction("sum(i, 1, 100, i^2)", 338350, 1);
  expect_fraction("sum(i, 1, 3, sum(j, i, 3, i*j))", 25, 1);
  expect_fraction("sum(i, 3, 2, i)", 0, 1);  // an empty sum
}

TEST(TextExpression, FunctionsHaveQuadPrecision) {
  // Two roundings of a quad at most between the text and the same functions of libquadmath.
  const Quad tolerance(1e-33);
  EXPECT_LT(abs(value("sqrt(2)").quad() - sqrt(Quad(2))), tolerance);
  EXPECT_LT(abs(value("(1 - 1/sqrt(3))/2").quad() - (Quad(1) - Quad(1) / sqrt(Quad(3))) / Quad(2)),
            tolerance);
  EXPECT_LT(abs(value("tan(0.5)*cos(1/2) - sin(0.5)").quad()), tolerance);
  EXPECT_LT(abs(value("exp(log(7)) - 7").quad()), Quad(1e-32));
  EXPECT_LT(abs(value("sin(pi)").quad()), tolerance);
  EXPECT_LT(abs(value("2^(1/3)").quad() - pow(Quad(2), Quad(1) / Quad(3))), tolerance);
  EXPECT_GT(abs(value("sqrt(2)").quad() - Quad(1.4142135623730951)), tolerance);  // a double is seen
}

// Values of 40 digits by mpmath.
TEST(TextExpression, FurtherFunctionsHaveQuadPrecision) {
  const std::vector<std::pair<std::string, std::string>> golden{
      {"atan(0.7)", "0.6107259643892086165437588764902360938185"},
      {"asin(3/10)", "0.3046926540153975079720029612275291669546"},
      {"acos(-0.4)", "1.982313172862384638616059589257087046954"},
      {"atan2(-1.2, -0.5)", "-1.965587446494658135971421222029332028994"},
      {"erf(0.8)", "0.7421009647076604861671105865029458773177"},
      {"tanh(1.3)", "0.8617231593133063642949537159367517988468"},
      {"sinh(-0.6)", "-0.636653582148241271123454375465148319025"},
      {"cosh(0.9)", "1.433086385448774387841790401624048341628"},
      {"atan2(2, -0.0) - pi/2", "0"},
      {"atan2(1e-30, -3) - pi", "-3.333333333333333333333333333333333333333e-31"},
      {"asin(1) - pi/2", "0"},
      {"acos(-1) - pi", "0"}};
  // Some roundings of numbers of order one.
  for (const auto& [text, exact] : golden)
    EXPECT_LT(abs(value(text).quad() - Real::parse(exact)->quad()), Quad(2e-33)) << text;
  EXPECT_GT(abs(value("erf(0.8)").quad() - Quad(0.7421009647076605)), Quad(1e-18));  // a double is seen
}

TEST(TextExpression, BranchesOfConstantsAreExact) {
  expect_fraction("abs(-1/3) + abs(1/3)", 2, 3);
  expect_fraction("sign(-0.1) + 10*sign(0) + 100*sign(7)", 99, 1);
  expect_fraction("min(1/3, 1/4) + max(-2, 3)", 13, 4);
  expect_fraction("select(1/3 < 0.4, 1, 2)", 1, 1);
  expect_fraction("select(1/3 > 0.4, 1, 2)", 2, 1);
  expect_fraction("select(2 < 2, 1, 2) + 10*select(2 <= 2, 1, 2)", 12, 1);
  expect_fraction("select(2 > 2, 1, 2) + 10*select(2 >= 2, 1, 2)", 12, 1);
  expect_fraction("select(3 <= 2, 1, 2) + 10*select(1 >= 2, 1, 2)", 22, 1);
}

// The results of items at z = (0.3, -0.7), and their derivatives in the first coordinate.
template <class T>
std::vector<std::pair<double, double>> values_and_slopes(const std::vector<std::string>& items) {
  std::vector<Recorded> results;
  const Tape tape = [&] {
    Recorder recorder(2);
    Scope scope;
    scope.define("t", recorder.time());
    scope.define("x", recorder.inputs()[0]);
    scope.define("y", recorder.inputs()[1]);
    for (const std::string& item : items) scope.append(Expression(source(item)), results);
    return recorder.finish(results);
  }();
  using D = Dual<T, 1>;
  std::vector<D> out(results.size());
  const std::vector<D> z{D::variable(T(0.3), 0), D(T(-0.7))};
  Replay<D> replay(std::make_shared<const Tape>(tape));
  replay(D(T(0)), z.data(), out.data());
  std::vector<std::pair<double, double>> pairs;
  for (const D& x : out)
    pairs.emplace_back(static_cast<double>(x.value), static_cast<double>(x.derivative[0]));
  return pairs;
}

TEST(TextExpression, BranchesHaveTheValuesAndSlopesOfTheirSide) {
  const std::vector<std::string> items{"abs(x)",
                                       "abs(x*y)",
                                       "sign(y)*x",
                                       "min(x, x^2)",
                                       "max(y, x*y)",
                                       "select(x > y, x^2, log(y))",
                                       "select(x <= y, log(y), 3*x)",
                                       "select(x < t, vector(i, 1, 2, i*x), vector(i, 1, 2, x^(i+1)))"};
  const std::vector<std::pair<double, double>> expected{{0.3, 1},    {0.21, 0.7},   {-0.3, -1},
                                                        {0.09, 0.6}, {-0.21, -0.7}, {0.09, 0.6},
                                                        {0.9, 3},    {0.09, 0.6},   {0.027, 0.27}};
  for (const auto& found : {values_and_slopes<double>(items), values_and_slopes<Quad>(items)}) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].first, expected[k].first, 4e-16) << k;
      EXPECT_NEAR(found[k].second, expected[k].second, 4e-16) << k;
    }
  }
}

TEST(TextExpression, BranchesOfListsAreOfOneLength) {
  Scope scope;
  std::vector<Recorded> values;
  EXPECT_THROW(scope.append(Expression(source("select(1 < 2, vector(i, 1, 2, i), 3)")), values), TextError);
  expect_error("select(1 < 2, vector(i, 1, 2, i), 3)", "vector(...) stands for several values");
}

TEST(TextExpression, RecordsWhatCppRecords) {
  const Expression written(
      source("a*q[1]^2/2 + sum(i, 2, 3, sin(q[i] - q[i-1])/i) - t*r + pow(r, a) + tan(q1)"));
  const Real a = Real::fraction(3, 2);
  const auto tape =
      std::make_shared<const Tape>(record(3, 1, [&](const Recorded& t, In<Recorded> q, Out<Recorded> out) {
        Scope scope;
        scope.define("a", Recorded(a));
        scope.define("t", t);
        scope.define("q", std::vector<Recorded>(q.begin(), q.end()));
        scope.define("q1", q[0]);
        scope.define("r", Expression(source("sqrt(q[1]^2 + s)")));
        scope.define("s", Expression(source("q[2]^2")));
        out[0] = scope.evaluate(written);
      }));
  const auto formula = [](auto t, const auto& q) {
    const auto r = sqrt(q[0] * q[0] + q[1] * q[1]), three = r - r + 3;
    return three / 2 * q[0] * q[0] / 2 + sin(q[1] - q[0]) / 2 + sin(q[2] - q[1]) / 3 - t * r + r * sqrt(r) +
           sin(q[0]) / cos(q[0]);
  };
  const std::vector<double> z{0.7, -0.4, 1.9};
  double in_double = 0;
  Replay<double> replay(tape);
  replay(0.3, z.data(), &in_double);
  EXPECT_NEAR(in_double, formula(0.3, z), 4e-16);  // sums of numbers of order one
  const std::vector<Quad> quads{Quad(0.7), Quad(-0.4), Quad(1.9)};
  Quad in_quad;
  Replay<Quad> quad_replay(tape);
  quad_replay(Quad(0.3), quads.data(), &in_quad);
  EXPECT_LT(abs(in_quad - formula(Quad(0.3), quads)), Quad(4e-34));
}

TEST(TextExpression, DefinitionsAreEvaluatedOnceAndMayBeLists) {
  Scope scope;
  scope.define("n", Recorded(3));
  scope.define("x", std::vector{Expression(source("vector(i, 1, n, i^2)")), Expression(source("1/2"))});
  scope.define("all", Expression(source("vector(i, 1, n + 1, x[i]*2)")));
  EXPECT_EQ(to_string(scope.constant(Expression(source("sum(i, 1, 4, x[i]) + all[3]")))), "32.5");
  std::vector<Recorded> values;
  scope.append(Expression(source("x")), values);
  scope.append(Expression(source("vector(i, 1, 2, vector(j, 1, i, i*j))")), values);
  std::string text;
  for (const Recorded& x : values) text += to_string(x.constant()) + " ";
  EXPECT_EQ(text, "1 4 9 0.5 1 2 4 ");
  EXPECT_EQ(scope.whole_number(Expression(source("2*n"))), 6);
  EXPECT_EQ(Expression(source("sum(i, 1, n, i*a) + b[k] + a")).names(),
            (std::vector<std::string>{"a", "b", "k", "n"}));
}

TEST(TextExpression, ErrorsShowThePlace) {
  EXPECT_EQ(message("1 + 2*(3"),
            "model.toml:7:20: expected ')' for the '(' in column 7 of the text\n  1 + 2*(3\n          ^");
  EXPECT_EQ(
      message("1 +\n  2 $ 3"),
      "model.toml:8:5: expected a number, a name, a parenthesis or one of + - * / ^\n    2 $ 3\n      ^");
  expect_error("1 +", "model.toml:7:15: the expression ends here");
  expect_error("", "the expression ends here");
  expect_error("2 3", ":14: expected an operator such as * before '3'");
  expect_error("2 )", ":14: expected the end of the expression before ')'");
  expect_error("2**3", ":14: expected ^ for a power instead of **");
  expect_error("1 < 2", ":14: values are compared in the condition of select(condition, a, b) alone");
  expect_error("sqrt(1 < 2)", ":19: values are compared in the condition");
  expect_error("select((1 < 2), 3, 4)", ":22: values are compared in the condition");
  expect_error("select(1, 2, 3)",
               ":20: select: expected a comparison as its condition, such as x < y, before ','");
  expect_error("select(1 < 2 < 3, 2, 3)", ":25: select: expected one comparison as its condition");
  expect_error("select(1 < 2, 3)", "select: expected 3 arguments, got 2");
  expect_error("select(1 == 2, 3, 4)", ":21: expected + - * / ^, a number or a name; conditions of select");
  expect_error("sqrt 2", ":17: expected '(' behind the function 'sqrt'");
  expect_error("squrt(2)", ":12: unknown function 'squrt'; did you mean 'sqrt'?");
  expect_error("pow(2)", "pow: expected 2 arguments, got 1");
  expect_error("sum(i, 1, 2)", "as in sum(index, first, last, expression)");
  expect_error("sum(pi, 1, 2, 3)", "'pi' has a meaning of its own");
  expect_error("sum(1, 1, 2, 3)", "expected the name of an index");
  expect_error("1e9999", "'1e9999' is too large");
}

TEST(TextExpression, MeaninglessValuesAreRefused) {
  Scope scope;
  scope.define("mass", Recorded(2));
  scope.define("q", std::vector<Recorded>{Recorded(1), Recorded(2)});
  scope.define("a", Expression(source("1 + b")));
  scope.define("b", Expression(source("2*c")));
  scope.define("c", Expression(source("a")));
  scope.withhold("p1", "is no argument of the potential energy");
  expect_error("2*mas", ":14: unknown name 'mas'; did you mean 'mass'?", scope);
  expect_error("a", "'a' is defined by itself: a -> b -> c -> a", scope);
  expect_error("p1", "'p1' is no argument of the potential energy", scope);
  expect_error("q[3]", ":14: index 3 of 'q' is out of range; expected 1 .. 2", scope);
  expect_error("q[0]", "index 0 of 'q' is out of range", scope);
  expect_error("q[1/2]", "expected a whole number as index, got 0.5", scope);
  expect_error("q + 1", "'q' is a list of 2 numbers; expected one of them, q[index]", scope);
  expect_error("mass[1]", "'mass' is one number", scope);
  expect_error("sum(mass, 1, 2, 1)", "is the name of something else", scope);
  expect_error("sum(i, 1, 2, sum(i, 1, 2, i))", "is the name of something else", scope);
  expect_error("1/(mass - 2)", ":15: division by what is always zero", scope);
  expect_error("0^(-1)", "division by what is always zero", scope);
  expect_error("log(-1)", "this constant is not finite", scope);
  expect_error("1e4900*1e4900", "this constant is not finite", scope);
  expect_error("1 + vector(i, 1, 2, i)", "stands for several values", scope);
}

TEST(TextExpression, DepthAndWorkAreBounded) {
  for (const std::string part : {"(", "-", "2^", "sin(", "sum(i,1,"})
    expect_error(
        [&] {
          std::string deep;
          for (int k = 0; k < 100000; ++k) deep += part;
          return deep;
        }(),
        "inside one another");
  // Long is not deep.
  std::string chain = "1", product = "1";
  for (int k = 0; k < 20000; ++k) {
    chain += " + 1";
    product += "*1";
  }
  expect_fraction(chain, 20001, 1);
  expect_fraction(product, 1, 1);
  Scope scope;
  scope.limit_operations(10000);
  expect_error("sum(i, 1, 100000, sum(j, 1, 100000, 1))", "too many operations", scope);
  for (int k = 0; k < 5000; ++k)
    scope.define("a" + std::to_string(k), Expression(source("a" + std::to_string(k + 1))));
  expect_error("a0", "too deep inside one another", scope);
}
}  // namespace
