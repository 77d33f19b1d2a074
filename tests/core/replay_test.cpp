// Replay: a tape evaluated with doubles, quads and duals gives the same as the formula it was recorded from.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../eigen/decompositions.hpp"
#include "../formula_values.hpp"
#include "random_formula.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::condition_of;
using pfaff::testing::RandomFormula;
using pfaff::testing::shared;
using pfaff::testing::solved_by_eigen;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

constexpr unsigned formulas = 100;
constexpr int inputs = 3, outputs = 2, operations = 25;

// The largest difference between replay and formula over random points, relative to 1 + |value|.
template <class T, class Make>
double worst_difference(const RandomFormula& formula, const Tape& tape, const Make& make) {
  std::mt19937_64 random(formula.seed + 1);
  std::uniform_real_distribution<double> number(-2, 2);
  Replay<T> replay(shared(tape));
  double worst = 0;
  for (int point = 0; point < 5; ++point) {
    std::vector<T> z, replayed(outputs), direct(outputs);
    for (int k = 0; k < inputs; ++k) z.push_back(make(number(random), k));
    const T t = make(number(random), inputs);
    replay(t, z.data(), replayed.data());
    formula(t, In<T>(z), Out<T>(direct));
    const auto compare = [&](auto a, auto b) {
      worst = std::fmax(worst, static_cast<double>(abs(a - b) / (decltype(a)(1) + abs(b))));
      if (!isfinite(a)) worst = INFINITY;
    };
    for (std::size_t k = 0; k < outputs; ++k) {
      compare(value_of(replayed[k]), value_of(direct[k]));
      if constexpr (requires { direct[k].derivative; })
        for (std::size_t d = 0; d < direct[k].derivative.size(); ++d)
          compare(replayed[k].derivative[d], direct[k].derivative[d]);
    }
  }
  return worst;
}

// A chain of 25 operations, each of which may magnify a rounding error a few times: 1e4 units of round-off.
// Dual parts go through twice as many.
TEST(Replay, EqualsTheFormulaInEveryScalar) {
  for (unsigned seed = 0; seed < formulas; ++seed) {
    const RandomFormula formula{seed, inputs, outputs, operations};
    const Tape tape = formula.tape();
    EXPECT_LE(worst_difference<double>(formula, tape, [](double x, int) { return x; }), 1e-12) << seed;
    EXPECT_LE(worst_difference<Quad>(formula, tape, [](double x, int) { return Quad(x) / Quad(3); }), 1e-30)
        << seed;
    using D = Dual<double, 4>;
    EXPECT_LE(worst_difference<D>(formula, tape, [](double x, int k) { return D::variable(x, k); }), 1e-11)
        << seed;
    using Q = Dual<Quad, 2>;
    EXPECT_LE(worst_difference<Q>(formula, tape, [](double x, int k) { return Q::variable(Quad(x), k % 2); }),
              1e-29)
        << seed;
    // Control: another formula is seen to be another.
    const RandomFormula other{seed + formulas, inputs, outputs, operations};
    EXPECT_GT(worst_difference<double>(other, tape, [](double x, int) { return x; }), 1e-6) << seed;
  }
}

TEST(Replay, ARecordedReplayIsTheSameTape) {
  for (unsigned seed = 0; seed < formulas; ++seed) {
    const RandomFormula formula{seed, inputs, outputs, operations};
    const Tape tape = formula.tape();
    const Tape again = record(inputs, outputs, [&](const Recorded& t, Arguments z, Results out) {
      const auto y = evaluate(tape, t, z);
      std::copy(y.begin(), y.end(), out.begin());
    });
    EXPECT_EQ(again.code.size(), tape.code.size());
    EXPECT_EQ(again.state_begin, tape.state_begin);
    EXPECT_LE(worst_difference<double>(formula, again, [](double x, int) { return x; }), 1e-12) << seed;
  }
}

TEST(Replay, FollowsTheTime) {
  const auto tape = shared(record(1, 1, [](const Recorded& t, Arguments z, Results out) {
    out[0] =
        exp(-t) * z[0] + sin(t) + solve(std::vector<Recorded>{2, t, t, 3}, std::vector<Recorded>{t, 1})[1];
  }));
  ASSERT_GT(tape->state_begin, tape->time_begin + 5);  // most of it is hoisted
  const auto direct = [](double t, double z) {
    return std::exp(-t) * z + std::sin(t) + (2 - t * t) / (6 - t * t);
  };
  Replay<double> replay(tape);
  Replay<Dual<double, 1>> dual(tape);
  // Starting at t = 0, the time a replay is born with; staying; going; coming back; a sign of zero.
  for (const auto& [t, z] :
       {std::pair{0.0, 1.5}, {0.0, -2.0}, {0.7, -2.0}, {0.7, 3.0}, {0.0, 3.0}, {-0.0, 1.0}, {1.2, 1.0}}) {
    double value = 0;
    replay(t, &z, &value);
    EXPECT_NEAR(value, direct(t, z), 1e-15 * 10) << t;
    // The same value of time with another derivative is another time.
    for (const double rate : {1.0, -2.0}) {
      Dual<double, 1> time(t), state(z), result;
      time.derivative[0] = rate;
      dual(time, &state, &result);
      const double slope = rate * (-std::exp(-t) * z + std::cos(t) - 8 * t / ((6 - t * t) * (6 - t * t)));
      EXPECT_NEAR(result.derivative[0], slope, 1e-14) << t;
    }
  }
  double z = 1, value = 0;
  replay(NAN, &z, &value);
  EXPECT_TRUE(std::isnan(value));
  replay(0.7, &z, &value);
  EXPECT_NEAR(value, direct(0.7, 1), 1e-14);
}

TEST(Replay, SolvesLikeEigen) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 2 + trial % 5;
    const auto size = static_cast<std::size_t>(n);
    const auto tape = shared(record(n * n + n, n, [&](const Recorded&, Arguments z, Results out) {
      const auto x = solve(z.first(size * size), z.subspan(size * size));
      std::copy(x.begin(), x.end(), out.begin());
    }));
    using D = Dual<double, 1>;
    Eigen::MatrixXd a(n, n), da(n, n);
    Eigen::VectorXd b(n), db(n);
    std::vector<double> z;
    std::vector<D> dual;
    const auto fill = [&](double& value, double& slope) {
      value = number(random), slope = number(random);
      z.push_back(value);
      dual.emplace_back(value);
      dual.back().derivative[0] = slope;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) fill(a(i, j), da(i, j));
    for (int i = 0; i < n; ++i) fill(b(i), db(i));
    if (trial % 3 == 0) {  // a zero on the diagonal makes it exchange rows
      a(0, 0) = z[0] = dual[0].value = 0;
    }
    std::vector<double> x(size);
    std::vector<D> dx(size);
    Replay<double> plain(tape);
    Replay<D> directional(tape);
    plain(0, z.data(), x.data());
    directional(D(0), dual.data(), dx.data());
    const Eigen::VectorXd expected = solved_by_eigen(a, b);
    const Eigen::VectorXd slope = solved_by_eigen(a, db - da.lazyProduct(expected));
    const double condition = condition_of(a);
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      EXPECT_NEAR(x[k], expected(i), 4e-15 * condition * expected.norm());
      EXPECT_NEAR(dx[k].value, expected(i), 4e-15 * condition * expected.norm());
      EXPECT_NEAR(dx[k].derivative[0], slope(i),
                  4e-15 * condition * condition * (slope.norm() + expected.norm()));
    }
  }
}

TEST(Replay, ASingularSystemGivesNonFiniteNumbersAndIsForgotten) {
  const auto tape = shared(record(2, 2, [](const Recorded&, Arguments z, Results out) {
    const auto x = solve(std::vector<Recorded>{z[0], z[1], z[1], z[0]}, std::vector<Recorded>{1, 0});
    out[0] = x[0];
    out[1] = x[1];
  }));
  Replay<double> replay(tape);
  Replay<Dual<Quad, 1>> dual(tape);
  for (const double z : {1.0, 3.0, 1.0}) {
    const double singular[] = {2, 2}, zero[] = {0, 0}, regular[] = {z, 2};
    double x[2];
    replay(0, singular, x);
    EXPECT_FALSE(std::isfinite(x[0]) || std::isfinite(x[1]));
    replay(0, zero, x);
    EXPECT_FALSE(std::isfinite(x[0]) || std::isfinite(x[1]));
    replay(0, regular, x);
    EXPECT_NEAR(x[0], z / (z * z - 4), 1e-15);
    const Dual<Quad, 1> point[] = {Quad(2), Quad(2)};
    Dual<Quad, 1> y[2];
    dual(0, point, y);
    EXPECT_FALSE(isfinite(y[0].value));
  }
}

TEST(Replay, PowersOfEverySign) {
  const auto power = [](const Real& y, auto x) {
    using T = decltype(x);
    Replay<T> replay(
        shared(record(1, 1, [&](const Recorded&, Arguments z, Results out) { out[0] = pow(z[0], y); })));
    T value;
    replay(T(0), &x, &value);
    return value;
  };
  for (const int n : {-33, -32, -7, -3, -2, -1, 0, 1, 2, 3, 10, 31, 32, 33, 40})
    for (const double x : {-1.75, -0.5, 0.3, 2.0}) {
      const Quad expected = pow(Quad(x), Quad(n));
      // 40 multiplications, each rounded once.
      EXPECT_NEAR(power(Real(n), x), static_cast<double>(expected),
                  1e-14 * std::fabs(static_cast<double>(expected)));
      EXPECT_LE(abs(power(Real(n), Quad(x)) - expected), Quad(1e-32) * abs(expected)) << n << " " << x;
    }
  for (const Real& y : {Real::fraction(1, 2), Real::fraction(-1, 2), Real::fraction(5, 2),
                        Real::fraction(-7, 2), Real::fraction(65, 2), Real::fraction(1, 3), -0.1_r})
    for (const double x : {0.3, 2.0}) {
      const Quad expected = pow(Quad(x), y.quad());
      EXPECT_LE(abs(power(y, Quad(x)) - expected), Quad(1e-32) * abs(expected)) << to_string(y);
      EXPECT_TRUE(std::isnan(power(y, -x)));
    }
  EXPECT_EQ(power(Real::fraction(3, 2), 0.0), 0.0);
  EXPECT_EQ(power(Real(-1), 0.0), INFINITY);
}

TEST(Replay, SelectTakesTheFirstBranchAboveZeroOnly) {
  const auto tape = shared(record(1, 1, [](const Recorded&, Arguments z, Results out) {
    out[0] = select(z[0], sqrt(z[0]), -z[0]);  // sqrt is NaN where it is not taken
  }));
  Replay<double> replay(tape);
  for (const auto& [z, expected] : {std::pair{4.0, 2.0}, {-4.0, 4.0}, {0.0, 0.0}, {1e-300, 1e-150}}) {
    double value = 0;
    replay(0, &z, &value);
    EXPECT_EQ(value, expected);
  }
}

TEST(Replay, ReplaysOfOneTapeAreIndependent) {
  const auto tape = shared(RandomFormula{3, inputs, outputs, operations}.tape());
  Replay<double> first(tape), second(tape);
  const double a[] = {0.1, 0.2, 0.3}, b[] = {-0.5, 1.2, 0.9};
  double before[outputs], after[outputs], other[outputs];
  first(0.4, a, before);
  second(0.9, b, other);
  first(0.4, a, after);
  for (int k = 0; k < outputs; ++k) EXPECT_EQ(before[k], after[k]);
}

}  // namespace
