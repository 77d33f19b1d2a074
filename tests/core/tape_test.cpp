// Recording: what a formula becomes on its tape, and which simplifications are made on the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/core/tape/linear.hpp>
#include <pfaff/core/tape/polynomial_degree.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "random_formula.hpp"

namespace {
using namespace pfaff;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

long count(const Tape& tape, Operation operation) {
  return std::count_if(tape.code.begin(), tape.code.end(),
                       [&](const Instruction& i) { return i.operation == operation; });
}
// The tape of one expression of two variables and time.
template <class F>
Tape tape_of(const F& f) {
  return record(2, 1, [&](const Recorded& t, Arguments z, Results out) { out[0] = f(t, z[0], z[1]); });
}

TEST(Recording, FoldsZerosAndOnes) {
  const Tape tape = tape_of([](const Recorded& t, const Recorded& x, const Recorded& y) {
    const Recorded zero = x * 0 + 0 * exp(t) + (x - x);
    EXPECT_TRUE(structurally_zero(zero));
    EXPECT_TRUE(structurally_zero(zero / x));
    return 1 * y * 1 + zero - 0 + 0 * x / y;
  });
  ASSERT_EQ(tape.code.size(), 1U);
  EXPECT_EQ(tape.code[0], (Instruction{Operation::input, 1, 0, 0}));
  // Control: what is not a one is kept.
  EXPECT_EQ(count(tape_of([](auto&, auto& x, auto&) { return x * Recorded(Real::fraction(10, 11)); }),
                  Operation::multiply),
            1);
}

TEST(Recording, FoldsSignsAndDivisionsByPowersOfTwo) {
  const Tape negated = tape_of([](auto&, auto& x, auto& y) { return x * (-1) + (0 - y); });
  EXPECT_EQ(count(negated, Operation::multiply), 0);
  EXPECT_EQ(count(negated, Operation::negate), 2);
  const Tape halved = tape_of([](auto&, auto& x, auto&) { return x / 8; });
  EXPECT_EQ(count(halved, Operation::divide), 0);
  EXPECT_TRUE(halved.constants[0] == Real::fraction(1, 8));
  EXPECT_EQ(count(tape_of([](auto&, auto& x, auto&) { return x / 3; }), Operation::divide), 1);
}

// A sum of two equal multiples is one multiple with the same bits, as a number that is twice a half is
// itself.
TEST(Recording, DoublesConstantFactors) {
  const auto twice = [](const Recorded& x) { return x + x; };
  const Tape whole = tape_of([&](auto&, auto& x, auto&) { return twice(x / 2); });
  EXPECT_EQ(whole.code[static_cast<std::size_t>(whole.outputs[0])].operation, Operation::input);
  const Tape thirds =
      tape_of([&](auto&, auto& x, auto&) { return twice(x * Recorded(Real::fraction(1, 3))); });
  EXPECT_EQ(count(thirds, Operation::add), 0);
  EXPECT_TRUE(thirds.constants[0] == Real::fraction(2, 3));
  Replay<double> replay(std::make_shared<const Tape>(thirds));
  for (const double x : {0.1, -7.3, 1e300, 3e-300}) {
    const double z[] = {x, 0};
    double result = 0;
    replay(0, z, &result);
    EXPECT_EQ(result, x * (1.0 / 3) + x * (1.0 / 3));
  }
  // Not where there is no constant factor, and a product with zero that stands for a domain stays one.
  EXPECT_EQ(count(tape_of([&](auto&, auto& x, auto& y) { return twice(x * y); }), Operation::add), 1);
  const Tape domain = tape_of([&](auto&, auto& x, auto&) { return twice(nothing_of(sqrt(x))); });
  EXPECT_EQ(count(domain, Operation::square_root), 1);
}

TEST(Recording, ConstantsFoldExactly) {
  const Tape tape = tape_of([](const Recorded&, const Recorded& x, const Recorded&) {
    const Recorded third = Recorded(1) / 3;
    return x * (third + third + sin(Recorded(0)) + cos(Recorded(0)) + sqrt(Recorded(4)));
  });
  ASSERT_EQ(tape.constants.size(), 1U);
  EXPECT_TRUE(tape.constants[0].is_fraction());
  EXPECT_EQ(tape.constants[0].numerator(), 11);
  EXPECT_EQ(tape.constants[0].denominator(), 3);
  EXPECT_EQ(
      tape_of([](auto&, auto&, auto&) { return select(Recorded(-1), Recorded(1), Recorded(2)); }).code.size(),
      1U);
  static_assert(!std::is_convertible_v<double, Recorded>, "a double would be cut to an int");
}

TEST(Recording, SharesCommonSubexpressions) {
  const Tape tape = tape_of([](const Recorded& t, const Recorded& x, const Recorded& y) {
    return (x * y) * exp(t + x) + exp(x + t) / (y * x);
  });
  EXPECT_EQ(count(tape, Operation::exponential), 1);
  EXPECT_EQ(count(tape, Operation::multiply), 2);
  EXPECT_EQ(count(tape, Operation::add), 2);
  // Subtraction and division have an order.
  const Tape ordered = tape_of([](auto&, auto& x, auto& y) { return (x - y) * (y - x) + x / y + y / x; });
  EXPECT_EQ(count(ordered, Operation::subtract), 2);
  EXPECT_EQ(count(ordered, Operation::divide), 2);
}

TEST(Recording, KeepsSineAndCosineTogether) {
  const auto expect_pairs = [](const Tape& tape, long pairs) {
    EXPECT_EQ(count(tape, Operation::sine), pairs);
    EXPECT_EQ(count(tape, Operation::cosine), pairs);
    for (std::size_t k = 0; k < tape.code.size(); ++k)
      if (tape.code[k].operation == Operation::sine) {
        ASSERT_LT(k + 1, tape.code.size());
        EXPECT_EQ(tape.code[k + 1], (Instruction{Operation::cosine, tape.code[k].a, 0, 0}));
      }
  };
  expect_pairs(tape_of([](auto&, auto& x, auto&) { return sin(x); }), 1);
  expect_pairs(tape_of([](auto&, auto& x, auto&) { return cos(x); }), 1);
  expect_pairs(tape_of([](auto&, auto& x, auto&) { return cos(x) * sin(x) + cos(x); }), 1);
  expect_pairs(tape_of([](auto& t, auto& x, auto& y) { return cos(x * y) + sin(y * x) + cos(t); }), 2);
}

TEST(Recording, RemovesDeadCode) {
  const Tape tape = tape_of([](const Recorded& t, const Recorded& x, const Recorded& y) {
    const Recorded unused =
        exp(x * t) + solve(std::vector<Recorded>{x, y, y, t}, std::vector<Recorded>{x, y})[1];
    return y + 2 + 0 * unused;
  });
  EXPECT_EQ(tape.code.size(), 3U);
  EXPECT_TRUE(tape.solves.empty());
}

TEST(Recording, OrdersConstantsTimeAndState) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Tape tape = pfaff::testing::RandomFormula{seed, 3, 2, 25}.tape();
    const int size = static_cast<int>(tape.code.size());
    ASSERT_LE(0, tape.time_begin);
    ASSERT_LE(tape.time_begin, tape.state_begin);
    ASSERT_LE(tape.state_begin, size);
    for (int k = 0; k < size; ++k) {
      const Instruction& i = tape.code[static_cast<std::size_t>(k)];
      EXPECT_EQ(i.operation == Operation::constant, k < tape.time_begin);
      EXPECT_TRUE(i.operation != Operation::time || k < tape.state_begin);
      EXPECT_TRUE(i.operation != Operation::input || k >= tape.state_begin);
      // Operands come before, those of the time part from before the state part.
      const auto before = [&](int slot) { return slot >= 0 && slot < k; };
      switch (i.operation) {
        case Operation::constant:
        case Operation::time:
        case Operation::input:
          break;
        case Operation::add:
        case Operation::subtract:
        case Operation::multiply:
        case Operation::divide:
          EXPECT_TRUE(before(i.a) && before(i.b));
          break;
        case Operation::select:
          EXPECT_TRUE(before(i.a) && before(i.b) && before(i.c));
          break;
        case Operation::solve:
          for (const int slot : tape.solves[static_cast<std::size_t>(i.a)].matrix) EXPECT_TRUE(before(slot));
          for (const int slot : tape.solves[static_cast<std::size_t>(i.a)].right_hand_side)
            EXPECT_TRUE(before(slot));
          break;
        case Operation::solve_next:
          EXPECT_EQ(tape.code[static_cast<std::size_t>(k - i.b)].operation, Operation::solve);
          break;
        default:
          EXPECT_TRUE(before(i.a));
      }
    }
    for (const int slot : tape.outputs) EXPECT_TRUE(slot >= 0 && slot < size);
  }
}

TEST(Recording, KnowsWhetherAllResultsAreZero) {
  const auto zero = [](const auto& f) { return tape_of(f).zero(); };
  EXPECT_TRUE(zero([](auto&, auto& x, auto&) { return x - x; }));
  EXPECT_FALSE(zero([](auto&, auto&, auto&) { return Recorded(1); }));
  EXPECT_FALSE(zero([](auto&, auto& x, auto&) { return x; }));
  EXPECT_FALSE(
      record(2, 2, [](const Recorded&, Arguments z, Results out) { out[0] = 0, out[1] = z[0]; }).zero());
}

TEST(Recording, KnowsWhatDependsOnTimeAndState) {
  const auto autonomous = [](const auto& f) { return tape_of(f).autonomous(); };
  EXPECT_TRUE(autonomous([](auto& t, auto& x, auto& y) { return x * y + 0 * t; }));
  EXPECT_TRUE(autonomous([](auto& t, auto& x, auto&) { return x + (t - t); }));
  EXPECT_FALSE(autonomous([](auto& t, auto& x, auto&) { return x + exp(sin(t)); }));
  EXPECT_FALSE(autonomous([](auto& t, auto& x, auto& y) { return select(t, x, y); }));
  EXPECT_FALSE(autonomous([](auto& t, auto& x, auto& y) { return pow(t, 0.3_r) * x / y; }));
  EXPECT_FALSE(autonomous([](auto& t, auto& x, auto& y) {
    return solve(std::vector<Recorded>{x, y, y, t}, std::vector<Recorded>{x, y})[1];
  }));
  EXPECT_TRUE(tape_of([](auto& t, auto&, auto&) { return exp(t) + 2; }).state_independent());
  EXPECT_TRUE(tape_of([](auto&, auto&, auto&) { return Recorded(3); }).state_independent());
  EXPECT_FALSE(tape_of([](auto& t, auto& x, auto&) { return exp(t) + x; }).state_independent());
}

TEST(Recording, KnowsWhatIsLinear) {
  const auto is_linear = [](const auto& f) { return linear(tape_of(f)); };
  EXPECT_TRUE(is_linear([](auto&, auto& x, auto& y) { return -(3 * x - y / 7) * pow(Recorded(2), 0.3_r); }));
  EXPECT_TRUE(is_linear([](auto&, auto& x, auto& y) {
    return solve(std::vector<Recorded>{2, 1, 1, 3}, std::vector<Recorded>{x, y - x})[1];
  }));
  EXPECT_FALSE(is_linear([](auto&, auto& x, auto&) { return x + 1; }));
  EXPECT_FALSE(is_linear([](auto&, auto& x, auto& y) { return x * y; }));
  EXPECT_FALSE(is_linear([](auto&, auto& x, auto&) { return 1 / x; }));
  EXPECT_FALSE(is_linear([](auto&, auto& x, auto& y) { return x * x / y; }));
  EXPECT_FALSE(is_linear([](auto& t, auto& x, auto&) { return t * x; }));
  EXPECT_FALSE(is_linear([](auto&, auto& x, auto& y) { return x + sin(y); }));
  EXPECT_FALSE(is_linear([](auto&, auto& x, auto& y) { return select(x, x, y); }));
  EXPECT_FALSE(is_linear([](auto&, auto& x, auto& y) {
    return solve(std::vector<Recorded>{2, 1, y, 3}, std::vector<Recorded>{x, x})[0];
  }));
  EXPECT_FALSE(is_linear([](auto&, auto&, auto&) { return Recorded(3); }));
}

TEST(Recording, KnowsTheIdentity) {
  const auto pair = [](int first, int second, int count) {
    return record(count, 2, [&](const Recorded&, Arguments z, Results out) {
      out[0] = z[static_cast<std::size_t>(first)];
      out[1] = z[static_cast<std::size_t>(second)];
    });
  };
  EXPECT_TRUE(identity(pair(0, 1, 2)));
  EXPECT_FALSE(identity(pair(1, 0, 2)));
  EXPECT_FALSE(identity(pair(0, 1, 3)));
  EXPECT_FALSE(identity(tape_of([](auto&, auto& x, auto&) { return 2 * x; })));
}

TEST(Recording, SmallPowersAreProductsAndRoots) {
  const auto power_of = [](const Real& y) {
    return tape_of([&](auto&, auto& x, auto&) { return pow(x, y); });
  };
  for (const int n : {0, 1, 2, 3, 7, 32, -1, -2, -32}) {
    EXPECT_EQ(count(power_of(Real(n)), Operation::power), 0) << n;
    EXPECT_EQ(count(power_of(Real(n)), Operation::divide), n < 0 ? 1 : 0) << n;
  }
  EXPECT_EQ(count(power_of(Real(8)), Operation::multiply), 3);
  EXPECT_EQ(count(power_of(Real::fraction(1, 2)), Operation::square_root), 1);
  // Of others than the root itself the derivative is right at 0 where they stay powers.
  for (const int n : {3, -1, -5}) EXPECT_EQ(power_of(Real::fraction(n, 2)).code.size(), 2U) << n;
  for (const Real& y : {Real(33), Real::fraction(1, 3), 0.1_r, Real(Quad(1) / Quad(7))})
    EXPECT_EQ(count(power_of(y), Operation::power), 1);
  // A recorded exponent that is a constant counts as one; another goes through the logarithm.
  EXPECT_EQ(count(tape_of([](auto&, auto& x, auto&) { return pow(x, Recorded(2)); }), Operation::multiply),
            1);
  EXPECT_EQ(count(tape_of([](auto&, auto& x, auto& y) { return pow(x, y); }), Operation::logarithm), 1);
}

// Whatever form a constant is kept in, its copies are the constant to the last bit, also when the original is
// gone.
TEST(Recording, ConstantsAreKeptExactly) {
  const Real large = Real::fraction(std::numeric_limits<int>::max(), 1);
  for (const Real& value : {Real(0), -Real(0), Real(-7), 0.3_r, Real::fraction(-1, 3), large, large + 1,
                            -large - 1, 1e18_r, sqrt(Real(2)), Real(std::numeric_limits<Quad>::infinity())}) {
    Recorded copy;
    {
      Recorded original(value);
      copy = original;
      original = 5;
      Recorded moved(std::move(copy));
      copy = std::move(moved);
    }
    const Real kept = copy.constant();
    EXPECT_TRUE(copy.is_constant());
    EXPECT_TRUE(kept == value) << to_string(kept);
    EXPECT_EQ(kept.value(), value.value());
    EXPECT_EQ(std::signbit(kept.value()), std::signbit(value.value()));
    EXPECT_EQ(kept.is_fraction(), value.is_fraction());
    EXPECT_EQ(kept.denominator(), value.denominator());
    EXPECT_EQ(kept.numerator(), value.numerator());
    EXPECT_EQ(copy.is(0), value.is(0));
  }
  EXPECT_EQ(sizeof(Recorded), 2 * sizeof(void*));
}

// Products of small integers that are no longer small.
TEST(Recording, LargeProductsOfConstantsAreExact) {
  const Recorded large(100000);
  EXPECT_TRUE((large * large).constant() == Real::fraction(10000000000, 1));
  EXPECT_TRUE((large * large * large).constant() == Real::fraction(1000000000000000, 1));
  EXPECT_TRUE((large * Recorded(-3)).is(-300000));
}

TEST(Recording, SolvesThatNeedNoPivotsAreDivisions) {
  const Tape monomial = record(2, 2, [](const Recorded& t, Arguments z, Results out) {
    const auto x = solve(std::vector<Recorded>{0, exp(t), -exp(t), 0}, z);
    out[0] = x[0];
    out[1] = x[1];
  });
  EXPECT_EQ(count(monomial, Operation::solve), 0);
  EXPECT_EQ(count(monomial, Operation::divide), 2);
  const Tape full = record(2, 2, [](const Recorded& t, Arguments z, Results out) {
    const auto x = solve(std::vector<Recorded>{0, exp(t), -exp(t), 1}, z);
    out[0] = x[0];
    out[1] = x[1];
  });
  EXPECT_EQ(count(full, Operation::solve), 1);
  EXPECT_EQ(count(full, Operation::solve_next), 1);
}

TEST(Recording, SystemsOfConstantsAreSolvedAsFractions) {
  const auto constants = [](std::initializer_list<int> list) {
    return std::vector<Recorded>(list.begin(), list.end());
  };
  const auto x = solve(constants({0, 2, 1, 3, 4, 0, 5, 6, 7}), constants({1, 1, 1}));
  // Cramer's rule by hand: determinant -44.
  const int numerators[] = {16, -23, 2};
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_TRUE(x[k].is_constant() && x[k].constant().is_fraction());
    EXPECT_TRUE(x[k].constant() == Real::fraction(numerators[k], 1) / Real(-44))
        << to_string(x[k].constant());
  }
  for (const Recorded& singular : solve(constants({1, 2, 2, 4}), constants({1, 1})))
    EXPECT_TRUE(isnan(singular.constant().quad()));
}

TEST(PolynomialDegree, IsBoundedByTheOperations) {
  const auto degree = [](const auto& f) { return polynomial_degree(tape_of(f)); };
  EXPECT_EQ(degree([](auto& t, auto&, auto&) { return sin(t) / (1 + t * t); }), 0);
  EXPECT_EQ(degree([](auto& t, auto& x, auto& y) { return x * x * y / exp(t) - 3 * y / 7; }), 3);
  EXPECT_EQ(degree([](auto&, auto& x, auto& y) { return pow(x + y * y, Real(3)) + x; }), 6);
  EXPECT_EQ(degree([](auto& t, auto& x, auto& y) { return select(t, x * t, x * y); }), std::nullopt);
  EXPECT_EQ(degree([](auto&, auto& x, auto& y) { return x + sin(y); }), std::nullopt);
  EXPECT_EQ(degree([](auto&, auto& x, auto& y) { return x / (1 + y * y); }), std::nullopt);
  EXPECT_EQ(degree([](auto&, auto& x, auto& y) { return x * sqrt(y); }), std::nullopt);
  EXPECT_EQ(degree([](auto&, auto& x, auto&) { return pow(x, Real::fraction(5, 2)); }), std::nullopt);
}
// The solution of a linear system is linear in its right-hand side, and rational in its matrix.
TEST(PolynomialDegree, OfSolutions) {
  const auto degree = [](bool constant) {
    return polynomial_degree(record(2, 2, [&](const Recorded& t, Arguments z, Results out) {
      const std::vector<Recorded> matrix{2 + t, Recorded(1), Recorded(1), constant ? 3 * t : z[0]};
      const auto x = solve(matrix, std::vector<Recorded>{z[0] * z[1], z[1]});
      out[0] = x[0];
      out[1] = x[1];
    }));
  };
  EXPECT_EQ(degree(true), 2);
  EXPECT_EQ(degree(false), std::nullopt);
}

}  // namespace
