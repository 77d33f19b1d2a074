// SeriesReplay: truncated power series of every operation, several lanes at once, and solutions of
// differential equations computed degree by degree.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/core/tape/series.hpp>

#include "../formula_values.hpp"
#include "random_formula.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::shared;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

constexpr int levels = 16;
constexpr std::size_t size = levels;

// Three lanes: x = a + b s with these a > 1 and b, |b/a| < 1.
struct Lane {
  double a, b;
};
constexpr Lane lane_values[] = {{1, 1}, {2.5, -0.75}, {1.25, 0.5}};
constexpr std::size_t lanes = 3;

// The coefficients of f(x), x = a + b s, one lane after the other; x is the state, or the time.
template <class T, class F>
std::vector<T> coefficients(const F& f, bool of_time) {
  const Tape tape =
      record(1, 1, [&](const Recorded& t, Arguments z, Results out) { out[0] = f(of_time ? t : z[0]); });
  SeriesReplay<T> series(shared(tape), levels, static_cast<int>(lanes));
  std::vector<T> t0, t1, zero(lanes), result(size * lanes);
  for (const Lane& lane : lane_values) {
    t0.push_back(T(lane.a));
    t1.push_back(T(lane.b));
  }
  series.set_time(t0.data(), t1.data());
  for (std::size_t l = 0; l < size; ++l) {
    series.set_input(l, l == 0 ? t0.data() : l == 1 ? t1.data() : zero.data());
    series.advance(l);
    for (std::size_t n = 0; n < lanes; ++n) result[n * size + l] = series.output(0, l)[n];
  }
  return result;
}

Quad binomial(const Real& r, int l) {
  Quad product(1);
  for (int k = 0; k < l; ++k) product *= (r.quad() - Quad(k)) / Quad(k + 1);
  return product;
}
Quad whole_power(Quad x, int n) {
  return n < 0 ? Quad(1) / whole_power(x, -n) : n == 0 ? Quad(1) : x * whole_power(x, n - 1);
}

// `expected(a, b, l)` is the coefficient of s^l. Coefficients come from recurrences of up to 16 terms that do
// not cancel: a few units of round-off, relative to the largest coefficient.
template <class F>
void expect_series(const char* name, const F& f, const std::function<Quad(Quad, Quad, int)>& expected) {
  for (const bool of_time : {false, true}) {
    const auto in_double = coefficients<double>(f, of_time);
    const auto in_quad = coefficients<Quad>(f, of_time);
    for (std::size_t n = 0; n < lanes; ++n) {
      Quad scale(0);
      std::vector<Quad> exact;
      for (int l = 0; l < levels; ++l) {
        exact.push_back(expected(Quad(lane_values[n].a), Quad(lane_values[n].b), l));
        scale = std::max(scale, abs(exact.back()));
      }
      for (std::size_t l = 0; l < size; ++l) {
        EXPECT_LE(static_cast<double>(abs(Quad(in_double[n * size + l]) - exact[l]) / scale), 1e-15)
            << name << " " << l;
        EXPECT_LE(static_cast<double>(abs(in_quad[n * size + l] - exact[l]) / scale), 1e-32)
            << name << " " << l;
      }
    }
  }
}

TEST(Series, OfEveryOperationHasTheTaylorCoefficients) {
  const auto power = [](const Real& r) {
    return [r](Quad a, Quad b, int l) {
      return binomial(r, l) * pow(a, r.quad() - Quad(l)) * whole_power(b, l);
    };
  };
  const auto factorial = [](int l) {
    Quad product(1);
    for (int k = 2; k <= l; ++k) product *= Quad(k);
    return product;
  };
  expect_series(
      "sum", [](auto& x) { return x + 3 - (-x); },
      [](Quad a, Quad b, int l) { return l == 0   ? Quad(2) * a + Quad(3)
                                         : l == 1 ? Quad(2) * b
                                                  : Quad(0); });
  expect_series(
      "square", [](auto& x) { return x * x; }, power(Real(2)));
  expect_series(
      "scaled", [](auto& x) { return 3 * x / 7 * x; },
      [&](Quad a, Quad b, int l) { return power(Real(2))(a, b, l) * Quad(3) / Quad(7); });
  expect_series(
      "reciprocal", [](auto& x) { return 1 / x; }, power(Real(-1)));
  expect_series(
      "quotient", [](auto& x) { return (x * x) / (x * x * x); }, power(Real(-1)));
  expect_series(
      "sqrt", [](auto& x) { return sqrt(x); }, power(Real::fraction(1, 2)));
  expect_series(
      "x^-1.7", [](auto& x) { return pow(x, -1.7_r); }, power(-1.7_r));
  expect_series(
      "x^(1/3)", [](auto& x) { return pow(x, Real::fraction(1, 3)); }, power(Real::fraction(1, 3)));
  expect_series(
      "x^(-5/2)", [](auto& x) { return pow(x, Real::fraction(-5, 2)); }, power(Real::fraction(-5, 2)));
  expect_series(
      "(-x)^33", [](auto& x) { return pow(-x, Real(33)); },
      [&](Quad a, Quad b, int l) { return -power(Real(33))(a, b, l); });
  expect_series(
      "exp", [](auto& x) { return exp(x); },
      [&](Quad a, Quad b, int l) { return exp(a) * whole_power(b, l) / factorial(l); });
  expect_series(
      "log", [](auto& x) { return log(x); },
      [](Quad a, Quad b, int l) { return l == 0 ? log(a) : -whole_power(-b / a, l) / Quad(l); });
  const auto wave = [&](Quad a, Quad b, int l, int shift) {
    const Quad values[] = {sin(a), cos(a), -sin(a), -cos(a)};
    return values[(l + shift) % 4] * whole_power(b, l) / factorial(l);
  };
  expect_series(
      "sin", [](auto& x) { return sin(x); }, [&](Quad a, Quad b, int l) { return wave(a, b, l, 0); });
  expect_series(
      "cos", [](auto& x) { return cos(x); }, [&](Quad a, Quad b, int l) { return wave(a, b, l, 1); });
  expect_series(
      "select, first", [](auto& x) { return select(x - 1 + exp(x), 1 / x, x); }, power(Real(-1)));
  expect_series(
      "select, second", [](auto& x) { return select(-x, x, 1 / x); }, power(Real(-1)));
  // [[x, 1], [1, 0]] u = (1, x): u = (x, 1 - x^2).
  expect_series(
      "solve",
      [](auto& x) {
        return solve(std::vector<Recorded>{x, 1, 1, 0}, std::vector<Recorded>{1, x})[1];
      },
      [&](Quad a, Quad b, int l) { return Quad(l == 0 ? 1 : 0) - power(Real(2))(a, b, l); });
  // [[2 x, x], [x, x]] u = (1, 1): u = (0, 1/x).
  expect_series(
      "solve",
      [](auto& x) {
        return solve(std::vector<Recorded>{2 * x, x, x, x}, std::vector<Recorded>{1, 1})[1];
      },
      power(Real(-1)));
}

TEST(Series, OfRandomFormulasSumToTheFormula) {
  const int inputs = 3, outputs = 2;
  const std::size_t n = 3, count = 2;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const auto tape = shared(pfaff::testing::RandomFormula{seed, inputs, outputs, 14}.tape());
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    // Inputs are cubics in s, other ones in every lane; time is t0 + t1 s.
    std::vector<Quad> z(4 * n * count), t0(count), t1(count), zero(n * count);
    for (auto* list : {&z, &t0, &t1})
      for (Quad& x : *list) x = Quad(number(random));
    SeriesReplay<Quad> series(tape, levels, static_cast<int>(count));
    series.set_time(t0.data(), t1.data());
    for (std::size_t l = 0; l < size; ++l) {
      series.set_input(l, l < 4 ? z.data() + l * n * count : zero.data());
      series.advance(l);
    }
    // At s = 1e-3 the first term left out is 1e-48 times a coefficient of the size of 1/radius^16.
    const Quad s(1e-3);
    Replay<Quad> replay(tape);
    for (std::size_t lane = 0; lane < count; ++lane) {
      Quad point[n], direct[outputs];
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 4; l-- > 0;) point[k] = point[k] * s + z[(l * n + k) * count + lane];
      replay(t0[lane] + s * t1[lane], point, direct);
      for (std::size_t k = 0; k < outputs; ++k) {
        Quad sum(0), shorter(0);
        for (std::size_t l = size; l-- > 0;) sum = sum * s + series.output(k, l)[lane];
        for (std::size_t l = 3; l-- > 0;) shorter = shorter * s + series.output(k, l)[lane];
        EXPECT_LE(abs(sum - direct[k]), Quad(1e-31)) << "seed " << seed;
        // Control: three terms do not sum to it.
        EXPECT_TRUE(abs(shorter - direct[k]) > Quad(1e-20) || abs(series.output(k, 3)[lane]) < Quad(1e-9));
      }
    }
  }
}

TEST(Series, FollowTheTimeWhenItIsSetAgain) {
  const auto tape =
      shared(record(1, 1, [](const Recorded& t, Arguments z, Results out) { out[0] = exp(t) * z[0]; }));
  ASSERT_EQ(tape->state_begin, 2);  // t and exp t
  SeriesReplay<double> series(tape, 3, 2);
  const double z[] = {1, 3}, zero[] = {0, 0};
  for (const double shift : {0.0, 0.5, 0.0}) {
    const double t0[] = {shift, -shift}, t1[] = {1, 2};
    series.set_time(t0, t1);
    for (std::size_t l = 0; l < 3; ++l) {
      series.set_input(l, l == 0 ? z : zero);
      series.advance(l);
      for (std::size_t n = 0; n < 2; ++n)
        EXPECT_NEAR(series.output(0, l)[n], z[n] * std::exp(t0[n]) * std::pow(t1[n], l) / (l == 2 ? 2 : 1),
                    1e-14);
    }
  }
}

// The Taylor series of z' = X(z, t): coefficient l + 1 is output l over l + 1.
std::vector<Quad> online(const std::shared_ptr<const Tape>& field, Quad t, const std::vector<Quad>& z,
                         std::size_t order) {
  const std::size_t n = z.size();
  SeriesReplay<Quad> series(field, static_cast<int>(order), 1);
  std::vector<Quad> x((order + 1) * n);
  std::copy(z.begin(), z.end(), x.begin());
  const Quad one(1);
  series.set_time(&t, &one);
  for (std::size_t l = 0; l < order; ++l) {
    series.set_input(l, x.data() + l * n);
    series.advance(l);
    for (std::size_t k = 0; k < n; ++k)
      x[(l + 1) * n + k] = *series.output(k, l) / Quad(static_cast<int>(l + 1));
  }
  return x;
}

TEST(Series, OnlineGiveTheTaylorSeriesOfSolutions) {
  const auto square =
      shared(record(1, 1, [](const Recorded&, Arguments z, Results out) { out[0] = z[0] * z[0]; }));
  for (const Quad x : online(square, Quad(0), {Quad(1)}, 40)) EXPECT_EQ(x, Quad(1));  // 1/(1 - s), exactly
  // x' = 2 t x from x(0) = 1: exp(s^2).
  const auto timed =
      shared(record(1, 1, [](const Recorded& t, Arguments z, Results out) { out[0] = 2 * t * z[0]; }));
  const auto x = online(timed, Quad(0), {Quad(1)}, 20);
  Quad coefficient(1);
  for (std::size_t l = 0; l <= 20; ++l) {
    if (l > 0 && l % 2 == 0) coefficient /= Quad(static_cast<int>(l / 2));
    EXPECT_LE(abs(x[l] - (l % 2 == 0 ? coefficient : Quad(0))), Quad(1e-33));
  }
}

TEST(Series, OfTheKeplerProblemSumToItsExactSolution) {
  const auto model = systems().get("kepler", "system").make({});
  const Problem<Quad> problem(model);
  std::vector<Quad> start{Quad(0.7), Quad(-0.2), Quad(0.3), Quad(1.1), Quad(0)}, exact(4);
  const Quad s(0.05);
  problem.exact_solution(s, start, exact);
  start.pop_back();
  const auto error = [&](std::size_t order) {
    const auto x = online(model->tape(Formula::field), Quad(0), start, order);
    Quad worst(0);
    for (std::size_t k = 0; k < 4; ++k) {
      Quad sum(0);
      for (std::size_t l = order + 1; l-- > 0;) sum = sum * s + x[l * 4 + k];
      worst = std::max(worst, abs(sum - exact[k]));
    }
    return static_cast<double>(worst);
  };
  EXPECT_LE(error(34), 1e-32);
  EXPECT_GT(error(12), 1e-25);  // control
}

}  // namespace
