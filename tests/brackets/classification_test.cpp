// Classification of constraints: ranks, classes and redundant constraints, the pivots that recursion chooses,
// and where plain orders break down and why.
#include <gtest/gtest.h>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/errors/errors.hpp>

#include "golden_brackets.hpp"
#include "random_gram.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::as;
using pfaff::testing::fraction;
using pfaff::testing::golden_brackets;
using pfaff::testing::golden_matrix;
using pfaff::testing::RandomGram;
using Indices = std::vector<std::size_t>;

Matrix<Rational> matrix(const std::vector<std::vector<Rational>>& rows) {
  Matrix<Rational> m(rows.size(), rows.front().size());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) m(i, j) = rows[i][j];
  return m;
}
Indices natural(std::size_t n) {
  Indices order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = k;
  return order;
}
std::vector<std::string> numbered(std::size_t n) {
  std::vector<std::string> names;
  for (std::size_t k = 1; k <= n; ++k) names.push_back("phi" + std::to_string(k));
  return names;
}
Symmetry symmetry_of(const std::string& kind) {
  return kind == "skew" ? Symmetry::skew : kind == "symmetric" ? Symmetry::symmetric : Symmetry::none;
}

// Every case breaks down in the order given, and no case breaks down with pivots.
TEST(Classification, ReferenceBreakDownsAreRegularWithPivots) {
  for (const auto& c : golden_brackets().at("breakdown_cases")) {
    const auto w = golden_matrix(c.at("W"));
    const Symmetry symmetry = symmetry_of(c.at("kind"));
    SCOPED_TRACE(c.at("name").get<std::string>());
    EXPECT_FALSE(plain_recursion(w, symmetry, natural(w.rows())).works);
    const auto exact = classify(w, symmetry);
    EXPECT_TRUE(exact.regular());
    EXPECT_EQ(exact.rank(), w.rows());
    const auto rounded = classify(as<double>(w), symmetry);
    EXPECT_TRUE(rounded.regular());
    // A regular skew W has an order that works; a symmetric one may have none (Example 3.1).
    if (symmetry == Symmetry::skew) {
      EXPECT_TRUE(plain_recursion(w, symmetry, rounded.order()).works);
      EXPECT_TRUE(plain_recursion(w, symmetry, exact.order()).works);
    }
  }
}

TEST(Classification, ExampleThreeOneNeedsAPairOrSumAndDifference) {
  const Rational a = fraction("7/3");
  const auto w = matrix({{0, a}, {a, 0}});
  const auto plain = plain_recursion(w, Symmetry::symmetric, natural(2));
  EXPECT_FALSE(plain.works);
  EXPECT_EQ(plain.at, Indices{0});
  EXPECT_EQ(describe(plain, Symmetry::symmetric, natural(2), {"x1", "x2"}),
            "order x1, x2: breaks down at step 1, <x1, x1> = 0: the leading minor of size 1 vanishes");
  EXPECT_FALSE(plain_recursion(w, Symmetry::symmetric, Indices{1, 0}).works);
  const auto pivoted = classify(w, Symmetry::symmetric);
  ASSERT_EQ(pivoted.pivots.size(), 1U);
  EXPECT_EQ(pivoted.pivots[0].rows, (Indices{0, 1}));
  EXPECT_EQ(pivoted.pivots[0].value, -a * a);
  const auto u = matrix({{1, 1}, {1, -1}});
  const auto combined = plain_recursion(u * w * u.transposed(), Symmetry::symmetric, natural(2));
  EXPECT_TRUE(combined.works);
  EXPECT_EQ(combined.pivots, (std::vector<Rational>{Rational(2) * a, Rational(-2) * a}));
}

// Leading principal minors decide, and no others: [[1, 2], [2, 0]] has a vanishing principal minor and works.
TEST(Classification, OnlyLeadingMinorsMustNotVanish) {
  const auto works = matrix({{1, 2}, {2, 0}});
  EXPECT_TRUE(plain_recursion(works, Symmetry::symmetric, natural(2)).works);
  EXPECT_FALSE(plain_recursion(works, Symmetry::symmetric, Indices{1, 0}).works);
  const auto breaks = matrix({{1, 1, 0}, {1, 1, 1}, {0, 1, 0}});
  const auto plain = plain_recursion(breaks, Symmetry::symmetric, natural(3));
  EXPECT_EQ(plain.at, Indices{1});
  EXPECT_EQ(plain.pivots, std::vector<Rational>{Rational(1)});
  EXPECT_EQ(
      describe(plain, Symmetry::symmetric, natural(3), numbered(3)),
      "order phi1, phi2, phi3: breaks down at step 2, <phi2, phi2>^(1) = 0: the leading minor of size 2 "
      "vanishes");
}

// nguyen-turski, proofs of Theorems 1 and 2: the pivots are ratios of leading minors (even ones, where skew,
// of which a pair's bracket squared is the ratio).
TEST(Classification, PlainPivotsAreRatiosOfLeadingMinors) {
  RandomGram random(1);
  for (const Symmetry symmetry : {Symmetry::symmetric, Symmetry::none, Symmetry::skew}) {
    const std::size_t step = symmetry == Symmetry::skew ? 2 : 1;
    for (int instance = 0; instance < 40; ++instance) {
      const auto w = random.of(symmetry, step * random.size(1, 4));
      const auto plain = plain_recursion(w, symmetry, natural(w.rows()));
      Rational before(1);
      std::size_t k = 0;
      for (; k < plain.pivots.size(); ++k) {
        const std::size_t size = (k + 1) * step;
        const Rational minor = determinant(w.block(0, 0, size, size));
        const Rational pivot = plain.pivots[k];
        ASSERT_EQ(step == 2 ? pivot * pivot : pivot, minor / before);
        before = minor;
      }
      if (!plain.works) {
        const std::size_t size = (k + 1) * step;
        ASSERT_EQ(determinant(w.block(0, 0, size, size)), Rational(0));
      } else {
        ASSERT_EQ(k * step, w.rows());
      }
    }
  }
}

// W = [[0, S], [-S^T, A]] of holonomic constraints, all phi before all phit, breaks down at {phi1, phi2} = 0
// for two constraints and more; phi1, phit1, phi2, phit2, ... has pivots det S_k / det S_{k-1}, whatever A
// is.
TEST(Classification, HolonomicConstraintsInPairs) {
  RandomGram random(2);
  for (std::size_t count = 1; count <= 5; ++count) {
    const auto b = random.any(count, count + 2);
    const auto s = b * b.transposed(), a = random.of(Symmetry::skew, count);
    Matrix<Rational> w(2 * count, 2 * count);
    Indices pairs;
    for (std::size_t i = 0; i < count; ++i) {
      pairs.push_back(i);
      pairs.push_back(count + i);
      for (std::size_t j = 0; j < count; ++j) {
        w(i, count + j) = s(i, j);
        w(count + i, j) = -s(j, i);
        w(count + i, count + j) = a(i, j);
      }
    }
    const auto all_first = plain_recursion(w, Symmetry::skew, natural(2 * count));
    EXPECT_EQ(all_first.works, count == 1);
    EXPECT_EQ(all_first.pivots.size(), count == 1 ? 1U : 0U);
    const auto alternate = plain_recursion(w, Symmetry::skew, pairs);
    ASSERT_TRUE(alternate.works);
    Rational before(1);
    for (std::size_t k = 0; k < count; ++k) {
      const Rational minor = determinant(s.block(0, 0, k + 1, k + 1));
      EXPECT_EQ(alternate.pivots[k], minor / before);
      EXPECT_GT(alternate.pivots[k], Rational(0));
      before = minor;
    }
    EXPECT_TRUE(classify(w, Symmetry::skew).regular());
  }
}

template <class T>
class Classes : public ::testing::Test {};
using Scalars = ::testing::Types<double, Quad, Rational>;
TYPED_TEST_SUITE(Classes, Scalars);

// Ranks are exact in every scalar; combinations vanish to round-off of their terms.
TYPED_TEST(Classes, RankAndNullCombinationsOfRandomBrackets) {
  using T = TypeParam;
  RandomGram random(3);
  for (const Symmetry symmetry : {Symmetry::symmetric, Symmetry::none, Symmetry::skew})
    for (int instance = 0; instance < 60; ++instance) {
      const std::size_t n = random.size(2, 9);
      std::size_t rank = random.size(1, n);
      if (symmetry == Symmetry::skew) rank = std::max<std::size_t>(2, rank / 2 * 2);
      const auto exact = random.of_rank(symmetry, n, std::min(rank, n));
      const auto w = as<T>(exact);
      // The entries carry the roundings of B R B^T, done exactly and rounded once.
      const auto found = classify(w, symmetry);
      ASSERT_EQ(found.rank(), std::min(rank, n));
      const auto check = [&](const Matrix<T>& m, const std::vector<Combination<T>>& combinations) {
        for (const auto& c : combinations)
          for (std::size_t i = 0; i < n; ++i) {
            T sum(0), size(0);
            for (std::size_t j = 0; j < n; ++j) {
              sum = sum + m(i, j) * c[j];
              size = size + abs(m(i, j) * c[j]);
            }
            // Entries below the pivots vanish to what elimination leaves: K^2 roundings of the terms, times
            // the condition of the pivots.
            const double bound = static_cast<double>(unit_roundoff<T>()) * found.condition *
                                 static_cast<double>(n * n) * static_cast<double>(size);
            ASSERT_LE(static_cast<double>(abs(sum)), bound);
          }
      };
      check(w, found.null);
      if (!found.principal) continue;
      ASSERT_EQ(found.null.size(), n - found.rank());
      check(w.transposed(), found.null_on_left);
      ASSERT_EQ(found.members(ConstraintClass::second).size(), found.rank());
    }
}

TYPED_TEST(Classes, RedundantConstraintsAreNamed) {
  using T = TypeParam;
  // phi1 = q1, phi2 = p1, phi3 = 2 q1 - 3 p1, phi4 = q2 with the canonical bracket of (q1, q2, p1, p2).
  Matrix<T> gradients(4, 4);
  gradients(0, 0) = T(1);
  gradients(1, 2) = T(1);
  gradients(2, 0) = T(2);
  gradients(2, 2) = T(-3);
  gradients(3, 1) = T(1);
  Matrix<T> j(4, 4);
  j(0, 2) = j(1, 3) = T(1);
  j(2, 0) = j(3, 1) = T(-1);
  const auto found = classify(gradients * j * gradients.transposed(), Symmetry::skew, gradients);
  EXPECT_EQ(found.classes,
            (std::vector<ConstraintClass>{ConstraintClass::second, ConstraintClass::second,
                                          ConstraintClass::redundant, ConstraintClass::first}));
  ASSERT_EQ(found.dependent.size(), 1U);
  EXPECT_EQ(found.dependent[0], (Combination<T>{T(-2), T(3), T(1), T(0)}));
  EXPECT_FALSE(found.regular());
  EXPECT_EQ(describe(found, numbered(4)),
            "phi1 and phi2 are second class (rank 2, condition of their brackets 1)\n"
            "pivots: {phi1, phi2} = 1\n"
            "phi4 is first class: phi4 has vanishing brackets with every constraint\n"
            "phi3 is redundant: the gradient of phi3 - 2 phi1 + 3 phi2 vanishes");
}

TEST(Classification, FirstClassCombinationsAreNamed) {
  // {phi1, phi2} = 1, phi3 = phi1 + phi2/2 as far as brackets go, phi4 commutes with everything.
  const Rational half = fraction("1/2");
  const auto w = matrix({{0, 1, half, 0}, {-1, 0, -1, 0}, {-half, 1, 0, 0}, {0, 0, 0, 0}});
  const auto found = classify(w, Symmetry::skew);
  EXPECT_EQ(found.rank(), 2U);
  EXPECT_EQ(describe(found, numbered(4)),
            "phi1 and phi2 are second class (rank 2, condition of their brackets 1)\n"
            "pivots: {phi1, phi2} = 1\n"
            "phi3 and phi4 are first class: phi3 - phi1 - 0.5 phi2; phi4 have vanishing brackets with every "
            "constraint");
}

// <phi1, phi2> = 1 and nothing else: rank 1, and no Dirac bracket for any subset.
TEST(Classification, RankWithoutASetThatCarriesIt) {
  const auto found = classify(matrix({{0, 1}, {0, 0}}), Symmetry::none);
  EXPECT_EQ(found.rank(), 1U);
  EXPECT_FALSE(found.principal);
  EXPECT_TRUE(found.members(ConstraintClass::second).empty());
  EXPECT_NE(describe(found, numbered(2)).find("there is no Dirac bracket"), std::string::npos);
  // The same row against two columns of which one will do.
  const auto carried = classify(matrix({{1, 5}, {0, 0}}), Symmetry::none);
  EXPECT_TRUE(carried.principal);
  EXPECT_EQ(carried.members(ConstraintClass::second), Indices{0});
  EXPECT_EQ(carried.null, (std::vector<Combination<Rational>>{{-5, 1}}));
  EXPECT_EQ(carried.null_on_left, (std::vector<Combination<Rational>>{{0, 1}}));
}

TEST(Classification, ConditionIsThatOfTheSecondClass) {
  Matrix<Rational> hilbert(3, 3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      hilbert(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = Rational(1) / Rational(i + j + 1);
  EXPECT_DOUBLE_EQ(classify(hilbert, Symmetry::symmetric).condition, 748);
  // 748 roundings of error in the estimate.
  EXPECT_NEAR(classify(as<double>(hilbert), Symmetry::symmetric).condition, 748, 748 * 748 * 0x1p-52);
  EXPECT_EQ(classify(Matrix<double>(2, 2), Symmetry::symmetric).condition, 1);
}

// The order phi1, phi2 | phi3, phi4 chosen where {phi1, phi2} = 1, at points where it shrinks to nothing.
TEST(Classification, AnOrderGoesBadElsewhere) {
  const auto at = [](double x) {
    Matrix<double> w(4, 4);
    const auto set = [&](std::size_t i, std::size_t j, double v) {
      w(i, j) = v;
      w(j, i) = -v;
    };
    set(0, 1, x);
    set(0, 2, 0.5);
    set(1, 3, 0.5);
    set(2, 3, 1);
    return w;
  };
  const auto chosen = classify(at(1), Symmetry::skew);
  EXPECT_EQ(chosen.order(), (Indices{0, 1, 2, 3}));
  EXPECT_TRUE(order_elsewhere(chosen, at(1)).good);
  EXPECT_EQ(order_elsewhere(chosen, at(1)).ratio, 1);
  EXPECT_TRUE(order_elsewhere(chosen, at(0.1)).good);
  const auto small = order_elsewhere(chosen, at(1e-6));
  EXPECT_FALSE(small.good);
  EXPECT_EQ(small.step, 0U);
  EXPECT_LT(small.ratio, 1e-5);
  const auto gone = order_elsewhere(chosen, at(0));
  EXPECT_FALSE(gone.good);
  EXPECT_EQ(gone.ratio, 0);
  // A rank that grows is never good: W of rank 2 here, 4 there.
  Matrix<double> lower(4, 4);
  lower(0, 1) = 1;
  lower(1, 0) = -1;
  const auto pair = classify(lower, Symmetry::skew);
  EXPECT_EQ(pair.rank(), 2U);
  EXPECT_TRUE(order_elsewhere(pair, lower).good);
  EXPECT_FALSE(order_elsewhere(pair, at(1)).good);
  EXPECT_FALSE(order_elsewhere(chosen, lower).good);
}

TEST(Classification, BadInputIsRefused) {
  EXPECT_THROW((void)classify(Matrix<double>(2, 3), Symmetry::none), InputError);
  EXPECT_THROW((void)classify(Matrix<double>(2, 2), Symmetry::none, Matrix<double>(3, 4)), InputError);
  Matrix<double> w(2, 2);
  w(0, 1) = std::nan("");
  EXPECT_THROW((void)classify(w, Symmetry::skew), InputError);
  EXPECT_THROW((void)plain_recursion(Matrix<double>(3, 3), Symmetry::skew, natural(3)), InputError);
}
}  // namespace
