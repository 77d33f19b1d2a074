// Derivatives of tapes, forward and reverse, against differences in quad.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include <pfaff/core/tape/derivatives.hpp>

#include "../formula_values.hpp"
#include "random_formula.hpp"
#include "relative_error.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::Numbers;
using pfaff::testing::RandomFormula;
using pfaff::testing::relative_error;
using pfaff::testing::shared;
using pfaff::testing::values;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

// Differences of fourth order with h = 1e-7: h^4 f^(5)/30 + u f/h, 1e-27 for derivatives of order one. The
// formulas are chains of a dozen operations, whose fifth derivatives reach 1e8.
constexpr double quotient_bound = 1e-18;
const Quad quotient_step(1e-7);

// d/ds of every output along (z + s direction, t + s rate).
Numbers difference_quotient(const Tape& tape, Quad t, Quad rate, const Numbers& z, const Numbers& direction) {
  const auto at = [&](int k) {
    const Quad s = Quad(k) * quotient_step;
    Numbers moved = z;
    for (std::size_t i = 0; i < z.size(); ++i) moved[i] += s * direction[i];
    return values(tape, t + s * rate, moved);
  };
  const Numbers a = at(1), b = at(-1), c = at(2), d = at(-2);
  Numbers slope(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    slope[i] = (Quad(8) * (a[i] - b[i]) - (c[i] - d[i])) / (Quad(12) * quotient_step);
  return slope;
}

struct Point {
  Quad t;
  Numbers z, direction;
};
Point random_point(unsigned seed, int inputs) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> number(-2, 2);
  Point p{Quad(number(random)), {}, {}};
  for (int k = 0; k < inputs; ++k) {
    p.z.push_back(Quad(number(random)));
    p.direction.push_back(Quad(number(random)));
  }
  return p;
}
Numbers unit(int size, int k) {
  Numbers e(static_cast<std::size_t>(size));
  e[static_cast<std::size_t>(k)] = Quad(1);
  return e;
}

constexpr unsigned differentiated_formulas = 60;
constexpr int differentiated_operations = 14;

// inputs > outputs is differentiated in reverse, inputs <= outputs forward.
const struct { int inputs, outputs; } shapes[] = {{4, 1}, {3, 2}, {2, 4}};

TEST(Derivatives, JacobiansAgreeWithDifferences) {
  for (const auto& [n, m] : shapes)
    for (unsigned seed = 0; seed < differentiated_formulas; ++seed) {
      const Tape tape = RandomFormula{seed, n, m, differentiated_operations}.tape();
      const auto [t, z, direction] = random_point(seed, n);
      const Numbers jacobian = values(jacobian_tape(tape), t, z);
      ASSERT_EQ(jacobian.size(), static_cast<std::size_t>(n * m));
      double wrong = 0;
      for (int j = 0; j < n; ++j) {
        const Numbers column = difference_quotient(tape, t, Quad(0), z, unit(n, j));
        for (int i = 0; i < m; ++i) {
          const Quad element = jacobian[static_cast<std::size_t>(i * n + j)],
                     expected = column[static_cast<std::size_t>(i)];
          EXPECT_LE(relative_error(element, expected), quotient_bound)
              << "seed " << seed << ", " << i << " " << j;
          wrong = std::fmax(wrong, relative_error(element * Quad(1 + 1e-9), expected));
        }
      }
      // Control: derivatives wrong by 1e-9 are seen, unless the formula is constant.
      EXPECT_TRUE(wrong < 1e-15 || wrong > quotient_bound * 1e3);
    }
}

TEST(Derivatives, ForwardReverseAndTimeAgreeWithDifferences) {
  for (unsigned seed = 0; seed < differentiated_formulas; ++seed) {
    const int n = 3;
    const Tape tape = RandomFormula{seed, n, 2, differentiated_operations}.tape();
    const auto [t, z, direction] = random_point(seed, n);
    const Recorded rate(Real::fraction(-3, 4));
    // Outputs: directional derivative (2), gradient of 2 f_1 - f_2/3 (3), time derivative (2).
    const Tape all =
        record(n, 7, [&, &direction = direction](const Recorded& time, Arguments x, Results out) {
          std::vector<Recorded> v;
          for (const Quad d : direction) v.emplace_back(Real(d));
          const std::vector<Recorded> weights{Recorded(2), Recorded(Real::fraction(-1, 3))};
          const auto forward = directional_derivative(tape, time, rate, x, v);
          const auto reverse = gradient(tape, time, x, weights);
          const auto timed = time_derivative(tape, time, x);
          std::copy(forward.begin(), forward.end(), out.begin());
          std::copy(reverse.begin(), reverse.end(), out.begin() + 2);
          std::copy(timed.begin(), timed.end(), out.begin() + 5);
        });
    const Numbers result = values(all, t, z);
    const Numbers along = difference_quotient(tape, t, Quad(-0.75), z, direction);
    const Numbers in_time = difference_quotient(tape, t, Quad(1), z, Numbers(3));
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_LE(relative_error(result[k], along[k]), quotient_bound) << seed;
      EXPECT_LE(relative_error(result[5 + k], in_time[k]), quotient_bound) << seed;
    }
    for (int k = 0; k < n; ++k) {
      const Numbers slope = difference_quotient(tape, t, Quad(0), z, unit(n, k));
      EXPECT_LE(
          relative_error(result[static_cast<std::size_t>(2 + k)], Quad(2) * slope[0] - slope[1] / Quad(3)),
          quotient_bound)
          << seed;
    }
  }
}

TEST(Derivatives, DifferentiatedTapesDifferentiateAgain) {
  for (unsigned seed = 0; seed < differentiated_formulas; ++seed) {
    const int n = 3;
    const Tape tape = RandomFormula{seed, n, 1, 10}.tape();
    const auto [t, z, direction] = random_point(seed, n);
    const Tape slope = jacobian_tape(tape);
    const Tape hessian_tape = jacobian_tape(slope);
    const Numbers hessian = values(hessian_tape, t, z);
    for (int j = 0; j < n; ++j) {
      const Numbers column = difference_quotient(slope, t, Quad(0), z, unit(n, j));
      for (int i = 0; i < n; ++i) {
        const Quad element = hessian[static_cast<std::size_t>(i * n + j)];
        // Symmetric up to the rounding of a chain of operations.
        EXPECT_LE(relative_error(element, hessian[static_cast<std::size_t>(j * n + i)]), 1e-30) << seed;
        EXPECT_LE(relative_error(element, column[static_cast<std::size_t>(i)]), quotient_bound) << seed;
      }
    }
    // Time and state derivatives commute.
    const Tape one = record(n, n, [&](const Recorded& time, Arguments x, Results out) {
      const auto d = time_derivative(slope, time, x);
      std::copy(d.begin(), d.end(), out.begin());
    });
    const Tape timed = record(n, 1, [&](const Recorded& time, Arguments x, Results out) {
      out[0] = time_derivative(tape, time, x)[0];
    });
    const Numbers a = values(one, t, z), b = values(jacobian_tape(timed), t, z);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(relative_error(a[k], b[k]), 1e-30) << seed;
  }
}

// Every operation by itself, in reverse and forward, where the derivative is known.
TEST(Derivatives, OfSingleOperations) {
  const auto slopes = [](const auto& f, double x, double y) {
    const Tape tape =
        record(2, 1, [&](const Recorded&, Arguments z, Results out) { out[0] = f(z[0], z[1]); });
    const Tape forward = record(2, 2, [&](const Recorded& t, Arguments z, Results out) {
      for (std::size_t k = 0; k < 2; ++k) {
        std::vector<Recorded> e(2);
        e[k] = Recorded(1);
        out[k] = directional_derivative(tape, t, Recorded(0), z, e)[0];
      }
    });
    const Numbers z{Quad(x), Quad(y)}, a = values(jacobian_tape(tape), Quad(0), z),
                                       b = values(forward, Quad(0), z);
    EXPECT_LE(relative_error(a[0], b[0]), 1e-33);
    EXPECT_LE(relative_error(a[1], b[1]), 1e-33);
    return std::pair{static_cast<double>(a[0]), static_cast<double>(a[1])};
  };
  const auto expect = [&](const auto& f, double x, double y, double dx, double dy) {
    const auto [a, b] = slopes(f, x, y);
    EXPECT_DOUBLE_EQ(a, dx);
    EXPECT_DOUBLE_EQ(b, dy);
  };
  expect([](auto& x, auto& y) { return x / y; }, 3, 4, 0.25, -3.0 / 16);
  expect([](auto& x, auto& y) { return pow(x, Real(3)) * y; }, -2, 5, 60, -8);
  expect([](auto& x, auto& y) { return pow(x, Real::fraction(-5, 2)) + y; }, 4, 5, -2.5 / 128, 1);
  expect([](auto& x, auto& y) { return pow(x, Real(33)) + y; }, -1, 5, 33, 1);
  expect([](auto& x, auto& y) { return pow(x, Real::fraction(4, 3)) + y; }, 8, 5, 8.0 / 3, 1);
  expect([](auto& x, auto& y) { return select(x, x * y, y); }, 2, 5, 5, 2);
  expect([](auto& x, auto& y) { return select(x, x * y, y); }, -2, 5, 0, 1);
  // x_2 of [[x, 1], [1, y]] (x_1, x_2) = (1, 0) is -1/(x y - 1).
  const auto solved = [](auto& x, auto& y) {
    return solve(std::vector<Recorded>{x, 1, 1, y}, std::vector<Recorded>{1, 0})[1];
  };
  expect(solved, 2, 3, 3.0 / 25, 2.0 / 25);
  // A variable that appears as an output, twice, and not at all.
  expect([](auto& x, auto&) { return x; }, 2, 3, 1, 0);
  expect([](auto&, auto&) { return Recorded(7); }, 2, 3, 0, 0);
}

// A branch that is not taken contributes nothing, even where its own derivative is not finite; forward and in
// reverse, nested, shared between branches and inside a solve.
TEST(Derivatives, TheOtherBranchOfSelectIsDiscarded) {
  const auto slope = [](const auto& f, double x, bool reverse) {
    const Tape tape =
        record(2, 1, [&](const Recorded&, Arguments z, Results out) { out[0] = f(z[0], z[1]); });
    const Tape derivative = record(2, 1, [&](const Recorded& t, Arguments z, Results out) {
      out[0] = reverse ? gradient(tape, t, z, std::vector<Recorded>{Recorded(1)})[0]
                       : directional_derivative(tape, t, Recorded(0), z, std::vector<Recorded>{1, 0})[0];
    });
    return static_cast<double>(values(derivative, Quad(0), {Quad(x), Quad(-1)})[0]);
  };
  for (const bool reverse : {false, true}) {
    const auto contact = [](auto& x, auto&) { return select(x, pow(x, 2.5_r), Recorded(0)); };
    EXPECT_EQ(slope(contact, -4, reverse), 0);
    EXPECT_EQ(slope(contact, 4, reverse), 20);
    const auto root = [](auto& x, auto&) { return select(x, sqrt(x), -x); };
    EXPECT_EQ(slope(root, -4, reverse), -1);
    EXPECT_EQ(slope(root, 4, reverse), 0.25);
    // The outer branch is not taken, whatever the inner condition says.
    const auto nested = [](auto& x, auto& y) { return select(y, select(-x, log(x), 1 / (x - 3)), x * x); };
    EXPECT_EQ(slope(nested, -4, reverse), -8);
    EXPECT_EQ(slope(nested, 3, reverse), 6);
    // A root used in branches of two selects, one of which is taken at x = 4, none at x = -4.
    const auto twice = [](auto& x, auto& y) { return select(x, sqrt(x), y) + select(x - 5, 3 * sqrt(x), x); };
    EXPECT_EQ(slope(twice, 4, reverse), 1.25);
    EXPECT_EQ(slope(twice, -4, reverse), 1);
    const auto singular = [](auto& x, auto& y) {
      return select(x, solve(std::vector<Recorded>{x, 2, 2, x}, std::vector<Recorded>{1, y})[0], x);
    };
    EXPECT_EQ(slope(singular, -2, reverse), 1);
    EXPECT_EQ(slope(singular, 4, reverse), -0.25);  // of 1/(x - 2), where y = -1
    // What both branches use is used always.
    const auto both = [](auto& x, auto& y) { return select(y, exp(x), 2 * exp(x)); };
    EXPECT_DOUBLE_EQ(slope(both, 1, reverse), 2 * std::exp(1.0));
  }
}

}  // namespace
