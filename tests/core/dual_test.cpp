// Dual numbers: every operation against differences in quad, and against identities between derivatives.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pfaff/core/numbers/dual.hpp>

#include "relative_error.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::relative_error;

// Central differences of step h have an error of h^2 f'''/6 + u f/h: 1e-21 at h = 1e-11 in quad, times what
// the derivatives of the functions below amount to.
constexpr double difference_bound = 1e-18;
// Second differences: h^2 f''''/12 + 4 u f/h^2, 1e-16 at h = 1e-9.
constexpr double second_difference_bound = 1e-14;
const Quad step(1e-11), second_step(1e-9);

// Calls check(name, f, x) for every function a formula may use, at arguments where it is smooth.
template <class Check>
void for_every_function(const Check& check) {
  const auto at = [&](const char* name, const auto& f, std::initializer_list<double> arguments) {
    for (const double x : arguments) check(name, f, Quad(x) / Quad(3));
  };
  at("sum", [](const auto& x) { return x + x * 2 - (-x); }, {-4, 0, 7});
  at("product", [](const auto& x) { return x * x * x; }, {-4, 0, 7});
  at("quotient", [](const auto& x) { return (x - 1) / (x * x + 1); }, {-4, 0, 7});
  at("reciprocal", [](const auto& x) { return 1 / x; }, {-4, 2, 7});
  at("sqrt", [](const auto& x) { return sqrt(x); }, {0.1, 2, 70});
  at("exp", [](const auto& x) { return exp(x); }, {-10, 0, 10});
  at("log", [](const auto& x) { return log(x); }, {0.1, 2, 70});
  at("sin", [](const auto& x) { return sin(x); }, {-10, 0, 10});
  at("cos", [](const auto& x) { return cos(x); }, {-10, 0, 10});
  at("cube", [](const auto& x) { return pow(x, Real(3)); }, {-4, 0, 7});
  at("inverse square", [](const auto& x) { return pow(x, Real(-2)); }, {-4, 2, 7});
  at("power of three halves", [](const auto& x) { return pow(x, Real::fraction(3, 2)); }, {1, 2, 7});
  at("power of -1.7", [](const auto& x) { return pow(x, -1.7_r); }, {1, 2, 7});
  at("power of zero", [](const auto& x) { return pow(x, Real(0)) * x; }, {-4, 0, 7});
  at("select, first", [](const auto& x) { return select(x * x + 1, x * x, sin(x)); }, {-4, 0, 7});
  at("select, second", [](const auto& x) { return select(-1 - x * x, x * x, sin(x)); }, {-4, 0, 7});
  at("composition", [](const auto& x) { return exp(sin(x) / (2 + cos(3 * x))) * sqrt(1 + x * x); },
     {-4, 0, 7});
}

TEST(Dual, FirstDerivativesAgreeWithDifferences) {
  for_every_function([](const char* name, const auto& f, Quad x) {
    const auto y = f(Dual<Quad, 1>::variable(x, 0));
    EXPECT_LE(relative_error(y.value, f(x)), 1e-33) << name;
    const Quad slope = (f(x + step) - f(x - step)) / (step + step);
    EXPECT_LE(relative_error(y.derivative[0], slope), difference_bound) << name << " at " << to_string(x, 5);
    // Control: a derivative that is wrong by one part in a million is seen.
    EXPECT_GT(relative_error(y.derivative[0] * Quad(1 + 1e-6) + Quad(1e-6), slope), difference_bound) << name;
  });
}

TEST(Dual, DoublesAgreeWithQuads) {
  for_every_function([](const char* name, const auto& f, Quad x) {
    const double rounded = static_cast<double>(x);
    const auto y = f(Dual<double, 1>::variable(rounded, 0));
    const auto exact = f(Dual<Quad, 1>::variable(Quad(rounded), 0));
    // A composition of half a dozen roundings.
    EXPECT_LE(relative_error(Quad(y.value), exact.value), 2e-15) << name;
    EXPECT_LE(relative_error(Quad(y.derivative[0]), exact.derivative[0]), 4e-15) << name;
  });
}

TEST(Dual, NestedDualsGiveSecondDerivatives) {
  for_every_function([](const char* name, const auto& f, Quad x) {
    using Second = Dual<Dual<Quad, 1>, 1>;
    Second variable(Dual<Quad, 1>::variable(x, 0));
    variable.derivative[0] = Dual<Quad, 1>(1);
    const Second y = f(variable);
    const Quad h = second_step, curvature = (f(x + h) - f(x) - (f(x) - f(x - h))) / (h * h);
    EXPECT_EQ(y.value.derivative[0], y.derivative[0].value) << name;
    EXPECT_LE(relative_error(y.derivative[0].derivative[0], curvature), second_difference_bound)
        << name << " at " << to_string(x, 5);
  });
}

TEST(Dual, EveryDirectionIsItsOwn) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(0.2, 2);
  const auto f = [](const auto& x, const auto& y, const auto& z) {
    return exp(x * y) / z + pow(z, 2.5_r) * sin(x - y);
  };
  for (int k = 0; k < 20; ++k) {
    const Quad a(number(random)), b(number(random)), c(number(random));
    using D = Dual<Quad, 3>;
    const D r = f(D::variable(a, 0), D::variable(b, 1), D::variable(c, 2));
    const Quad h2 = step + step;
    EXPECT_LE(relative_error(r.derivative[0], (f(a + step, b, c) - f(a - step, b, c)) / h2),
              difference_bound);
    EXPECT_LE(relative_error(r.derivative[1], (f(a, b + step, c) - f(a, b - step, c)) / h2),
              difference_bound);
    EXPECT_LE(relative_error(r.derivative[2], (f(a, b, c + step) - f(a, b, c - step)) / h2),
              difference_bound);
  }
}

TEST(Dual, DerivativesSatisfyIdentities) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> number(0.1, 3);
  using D = Dual<Quad, 2>;
  const auto equal = [](const D& a, const D& b) {
    EXPECT_LE(relative_error(a.value, b.value), 2e-33);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_LE(relative_error(a.derivative[k], b.derivative[k]), 2e-33);
  };
  for (int k = 0; k < 50; ++k) {
    const D x = D::variable(Quad(number(random)) / Quad(3), 0),
            y = D::variable(Quad(number(random)) / Quad(3), 1);
    equal(sin(x) * sin(x) + cos(x) * cos(x), D(1));
    equal(log(exp(x) * y), x + log(y));
    equal(sqrt(x * x), x);
    equal(pow(x, 2.5_r) * pow(x, -1.5_r), x);
    equal(pow(x, y), exp(y * log(x)));
    equal(x * y / y, x);
    equal((x + y) * (x - y), x * x - y * y);
  }
}

TEST(Dual, PowersOfNegativeNumbersHaveHigherDerivatives) {
  using Second = Dual<Dual<double, 1>, 1>;
  Second x(Dual<double, 1>::variable(-2, 0));
  x.derivative[0] = Dual<double, 1>(1);
  const Second y = pow(x, Real(3));
  EXPECT_DOUBLE_EQ(y.value.value, -8);
  EXPECT_DOUBLE_EQ(y.derivative[0].value, 12);
  EXPECT_DOUBLE_EQ(y.derivative[0].derivative[0], -12);
  // Half powers of negative numbers are not real, derivatives included.
  const auto none = pow(Dual<double, 1>::variable(-2, 0), Real::fraction(1, 2));
  EXPECT_TRUE(std::isnan(none.value) && std::isnan(none.derivative[0]));
}

TEST(Dual, TheOtherBranchOfSelectIsDiscarded) {
  using D = Dual<double, 1>;
  const D x = D::variable(-4, 0);
  const D y = select(x, sqrt(x), -x);  // sqrt is NaN here
  EXPECT_EQ(y.value, 4);
  EXPECT_EQ(y.derivative[0], -1);
}

TEST(Dual, IsAlignedForVectorsAndKeepsTheNumberBelow) {
  static_assert(alignof(Dual<double, 4>) == 32);
  static_assert(std::is_same_v<Value<Dual<Dual<Quad, 2>, 3>>, Quad>);
  EXPECT_EQ((value_of(Dual<Dual<double, 2>, 3>(Dual<double, 2>(2.5)))), 2.5);
  EXPECT_EQ((unit_roundoff<Dual<double, 1>>()), 0x1p-53);
}

}  // namespace
