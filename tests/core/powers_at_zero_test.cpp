// Powers that are no products, at 0: they have the derivatives there that exist, in every scalar and order.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/online_series.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/series.hpp>

#include "../formula_values.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::shared;

Tape power_of(const Real& r) {
  return record(1, 1, [&](const auto&, auto z, auto out) { out[0] = pow(z[0], r); });
}
// The n-th derivative as a tape.
Tape derivative(Tape tape, int n) {
  for (; n > 0; --n) tape = jacobian_tape(tape);
  return tape;
}
template <class T>
T tape_value_at(const Tape& tape, const T& x) {
  Replay<T> replay(shared(tape));
  T y(0);
  replay(T(0), &x, &y);
  return y;
}

const std::vector<Real>& exponents() {
  static const std::vector<Real> list{Real::fraction(3, 2),
                                      Real::fraction(5, 2),
                                      Real::fraction(7, 2),
                                      Real::fraction(31, 2),
                                      Real::fraction(7, 3),
                                      Real::fraction(4, 3),
                                      2.2_r};
  return list;
}

TEST(PowersAtZero, TapesHaveTheDerivativesThatExist) {
  for (const Real& r : exponents())
    for (int n = 0; n < 4; ++n) {
      const Tape tape = derivative(power_of(r), n);
      const double expected = n < r.value() ? 0 : std::numeric_limits<double>::infinity();
      EXPECT_EQ(std::abs(tape_value_at(tape, 0.0)), expected) << to_string(r) << " " << n;
      EXPECT_EQ(abs(tape_value_at(tape, Quad(0))), Quad(expected)) << to_string(r) << " " << n;
      const auto pack = tape_value_at(tape, Pack<4>(0.0));
      EXPECT_EQ(std::abs(pack[3]), expected) << to_string(r) << " " << n;
      if (n > r.value()) break;
    }
}

// Elsewhere: r (r - 1) ... x^(r - n), with the power of the C library.
TEST(PowersAtZero, DerivativesElsewhereAreWhatTheyWere) {
  std::vector<Real> all = exponents();
  for (const int n : {-1, -3, -5, 1}) all.push_back(Real::fraction(n, 2));
  for (const Real& r : all)
    for (const double x : {0.3, 1.7, 40.0}) {
      double factor = 1;
      for (int n = 0; n < 4; ++n) {
        const double expected = factor * std::pow(x, r.value() - n);
        // A dozen roundings.
        EXPECT_NEAR(tape_value_at(derivative(power_of(r), n), x) / expected, 1, 4e-15)
            << to_string(r) << " " << n;
        factor *= r.value() - n;
      }
    }
}

TEST(PowersAtZero, NegativeOnesAreInfinite) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const Real& r : {Real::fraction(-1, 2), Real::fraction(-3, 2), Real::fraction(-7, 2)}) {
    EXPECT_EQ(tape_value_at(power_of(r), 0.0), infinite) << to_string(r);
    EXPECT_EQ(tape_value_at(derivative(power_of(r), 1), 0.0), -infinite) << to_string(r);
    EXPECT_EQ(tape_value_at(derivative(power_of(r), 2), 0.0), infinite) << to_string(r);
  }
  EXPECT_TRUE(std::isnan(tape_value_at(power_of(Real::fraction(5, 2)), -1.0)));  // beyond the domain
}

// Values have the bits of products and a root, in every scalar.
TEST(PowersAtZero, ValuesAreProductsAndRoots) {
  for (const double x : {0.1, 2.0 / 3, 17.3}) {
    const double five = x * x * std::sqrt(x), three = std::sqrt(x) * x;
    EXPECT_EQ(tape_value_at(power_of(Real::fraction(5, 2)), x), five);
    EXPECT_EQ(pow(x, Real::fraction(3, 2)), three);
    EXPECT_EQ(pow(x, Real::fraction(-3, 2)), 1 / three);
    EXPECT_EQ(pow(Pack<4>(x), Real::fraction(5, 2))[2], five);
    EXPECT_EQ((pow(Dual<double, 1>(x), Real::fraction(5, 2)).value), five);
  }
}

TEST(PowersAtZero, DualsHaveThem) {
  using Second = Dual<Dual<double, 1>, 1>;
  Second x(Dual<double, 1>::variable(0.0, 0));
  x.derivative[0] = Dual<double, 1>(1);
  for (const Real& r : {Real::fraction(5, 2), Real::fraction(7, 3), Real(2), Real(3)}) {
    const Second y = pow(x, r);
    EXPECT_EQ(y.value.value, 0) << to_string(r);
    EXPECT_EQ(y.derivative[0].value, 0) << to_string(r);
    EXPECT_EQ(y.derivative[0].derivative[0], r.is(2) ? 2 : 0) << to_string(r);
  }
}

// Coefficients of x(s)^r for x = sum a_l s^l.
template <class T>
std::vector<T> series_of(const Real& r, const std::vector<T>& a) {
  SeriesReplay<T> series(shared(power_of(r)), static_cast<int>(a.size()), 1);
  const T zero(0);
  series.set_time(&zero, &zero);
  std::vector<T> result;
  for (std::size_t l = 0; l < a.size(); ++l) {
    series.set_input(l, &a[l]);
    series.advance(l);
    result.push_back(series.output(0, l)[0]);
  }
  return result;
}

TEST(PowersAtZero, SeriesHaveTheCoefficientsThatExist) {
  const Real r = Real::fraction(5, 2);
  for (const double x : series_of<double>(r, {0, 0, 0, 0, 0, 0})) EXPECT_EQ(x, 0);  // at rest
  const auto linear = series_of<double>(r, {0, 1.5, 0.25, 0, 0});
  for (std::size_t l = 0; l < 3; ++l) EXPECT_EQ(linear[l], 0) << l;
  EXPECT_FALSE(std::isfinite(linear[3]));  // control: s^(5/2) has no third derivative
  const auto square = series_of<Quad>(r, {Quad(0), Quad(0), Quad(2), Quad(1), Quad(0), Quad(0)});
  for (std::size_t l = 0; l < 5; ++l) EXPECT_EQ(square[l], Quad(0)) << l;  // |s|^5
  // The same numbers where the series does not begin with zero: (1 + s)^r.
  const auto known = series_of<double>(r, {1, 1, 0, 0});
  const double binomials[] = {1, 2.5, 1.875, 0.3125};
  for (std::size_t l = 0; l < 4; ++l) EXPECT_NEAR(known[l], binomials[l], 1e-15) << l;
  // The derivative that a dual carries, 5/2 a^(3/2) da, ends one coefficient earlier.
  using D = Dual<double, 1>;
  const auto carried = series_of<D>(r, {D::variable(0, 0), D(1), D(0), D(0)});
  for (std::size_t l = 0; l < 2; ++l) {
    EXPECT_EQ(carried[l].value, 0) << l;
    EXPECT_EQ(carried[l].derivative[0], 0) << l;
  }
  EXPECT_FALSE(std::isfinite(carried[2].derivative[0]));
}

// The same recurrences in compiled series.
TEST(PowersAtZero, CompiledSeriesHaveThem) {
  constexpr int levels = 4;
  std::array<Pack<2>, 2 * series_capacity> slots{};
  const auto run = [&](double slope) {
    std::array<double, levels> result{};
    for (int l = 0; l < levels; ++l) {
      SeriesRun<2> level{slots.data(), l, SeriesPass::state, 1};
      slots[static_cast<std::size_t>(l)] = Pack<2>(l == 1 ? slope : 0.0);
      pow(OnlineSeries<2>(level, 0, false), Real::fraction(5, 2));
      result[static_cast<std::size_t>(l)] = slots[static_cast<std::size_t>(series_capacity + l)][0];
    }
    return result;
  };
  for (const double x : run(0)) EXPECT_EQ(x, 0);
  const auto moving = run(1);
  for (std::size_t l = 0; l < 3; ++l) EXPECT_EQ(moving[l], 0) << l;
  EXPECT_FALSE(std::isfinite(moving[3]));
}

}  // namespace
