// Section 3 of nguyen-turski as identities between matrices of brackets, exact in rationals: Tanner's
// identities, the determinant form, Theorems 1 and 2 at every level, Propositions 4 and 5.
#include <gtest/gtest.h>

#include <pfaff/brackets/dirac/elimination.hpp>

#include "golden_brackets.hpp"
#include "random_gram.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;
using Indices = std::vector<std::size_t>;

// F[rows, columns], (3.1).
Rational minor(const Matrix<Rational>& f, const Indices& rows, const Indices& columns) {
  Matrix<Rational> m(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j) m(i, j) = f(rows[i], columns[j]);
  return determinant(m);
}
Indices with(Indices list, std::initializer_list<std::size_t> more) {
  list.insert(list.end(), more);
  return list;
}
Indices first_indices(std::size_t n) {
  Indices list;
  for (std::size_t k = 0; k < n; ++k) list.push_back(k);
  return list;
}
// (3.5) for the elements after the first `count`, which are the constraints.
Matrix<Rational> dirac_brackets(const Matrix<Rational>& g, std::size_t count) {
  const std::size_t rest = g.rows() - count;
  return g.block(count, count, rest, rest) - g.block(count, 0, rest, count) *
                                                 inverse(g.block(0, 0, count, count)) *
                                                 g.block(0, count, count, rest);
}
// Pf by expansion along the first row.
Rational pfaffian(const Matrix<Rational>& w) {
  const std::size_t n = w.rows();
  if (n == 0) return 1;
  Rational sum(0);
  for (std::size_t k = 1; k < n; ++k) {
    Indices rest;
    for (std::size_t i = 1; i < n; ++i)
      if (i != k) rest.push_back(i);
    Matrix<Rational> m(n - 2, n - 2);
    for (std::size_t i = 0; i < n - 2; ++i)
      for (std::size_t j = 0; j < n - 2; ++j) m(i, j) = w(rest[i], rest[j]);
    const Rational term = w(0, k) * pfaffian(m);
    sum = k % 2 == 1 ? sum + term : sum - term;
  }
  return sum;
}

TEST(TannerIdentities, HoldForRandomMatrices) {
  RandomGram random(10);
  for (int instance = 0; instance < 200; ++instance) {
    const std::size_t n = random.size(0, 4);
    const auto f = random.any(n + 3, n + 3);
    const auto a = first_indices(n);
    const std::size_t x = n, u = n + 1, v = n + 2, y = n, s = n + 1, t = n + 2;
    const auto m = [&](std::initializer_list<std::size_t> i, std::initializer_list<std::size_t> j) {
      return minor(f, with(a, i), with(a, j));
    };
    // (3.2) with z = u, and (3.3).
    ASSERT_EQ(m({}, {}) * m({x, u}, {y, t}), m({x}, {y}) * m({u}, {t}) - m({x}, {t}) * m({u}, {y}));
    ASSERT_EQ(
        m({}, {}) * m({x, u, v}, {y, s, t}),
        m({x}, {y}) * m({u, v}, {s, t}) - m({x}, {s}) * m({u, v}, {y, t}) + m({x}, {t}) * m({u, v}, {y, s}));
    // The sign of the second term turned: nothing else would say that the identities are tested.
    if (n > 0 && m({x}, {t}) * m({u}, {y}) != Rational(0)) {
      ASSERT_NE(m({}, {}) * m({x, u}, {y, t}), m({x}, {y}) * m({u}, {t}) + m({x}, {t}) * m({u}, {y}));
    }
  }
}

// (3.6), (3.7): the quotient of bordered determinants; (3.8), Theorem 1; constraints drop out.
TEST(RecursionOfGramMatrices, IsTheDiracBracketAtEveryLevel) {
  RandomGram random(11);
  int complete = 0;
  for (const Symmetry symmetry : {Symmetry::symmetric, Symmetry::none, Symmetry::skew}) {
    const std::size_t step = symmetry == Symmetry::skew ? 2 : 1;
    for (int instance = 0; instance < 40; ++instance) {
      const std::size_t count = step * random.size(1, 3);
      const auto g = random.of(symmetry, count + 3);
      Elimination<Rational> recursion(g, symmetry, Matrix<Rational>(0, 0), first_indices(count + 3));
      std::size_t done = 0;
      for (; done < count; done += step) {
        Pivot<Rational> pivot{{done}, {done}, {}};
        if (step == 2) pivot.rows = pivot.columns = {done, done + 1};
        if (recursion.value(pivot) == Rational(0)) break;
        recursion.eliminate(pivot);
        const auto expected = dirac_brackets(g, done + step);
        const Rational w = determinant(g.block(0, 0, done + step, done + step));
        for (std::size_t i = 0; i < count + 3; ++i)
          for (std::size_t j = 0; j < count + 3; ++j) {
            const bool eliminated = i < done + step || j < done + step;
            const Rational value = recursion(i, j);
            ASSERT_EQ(value, eliminated ? Rational(0) : expected(i - done - step, j - done - step));
            if (eliminated) continue;
            ASSERT_EQ(
                value,
                minor(g, with(first_indices(done + step), {i}), with(first_indices(done + step), {j})) / w);
          }
      }
      complete += done == count;
    }
  }
  EXPECT_GT(complete, 100);  // of 120: a random pivot rarely vanishes
}

// The levels of the reference file, every entry.
TEST(RecursionOfGramMatrices, ReferenceLevels) {
  for (const char* kind : {"symmetric", "general", "skew", "skew_canonical_R6"}) {
    SCOPED_TRACE(kind);
    const std::string name = kind;
    const Symmetry symmetry = name == "symmetric" ? Symmetry::symmetric
                              : name == "general" ? Symmetry::none
                                                  : Symmetry::skew;
    const auto& levels = golden_brackets().at(kind).at("levels");
    const auto g = golden_matrix(levels[0]);
    Elimination<Rational> recursion(g, symmetry, Matrix<Rational>(0, 0), first_indices(g.rows()));
    for (std::size_t k = 1; k < levels.size(); ++k) {
      Pivot<Rational> pivot{{k - 1}, {k - 1}, {}};
      if (symmetry == Symmetry::skew) pivot.rows = pivot.columns = {2 * k - 2, 2 * k - 1};
      recursion.eliminate(pivot);
      const auto expected = golden_matrix(levels[k]);
      for (std::size_t i = 0; i < g.rows(); ++i)
        for (std::size_t j = 0; j < g.rows(); ++j) ASSERT_EQ(recursion(i, j), expected(i, j));
    }
  }
}

// (3.18), Proposition 5, and the Pfaffian's quotient, which has the sign too.
TEST(RecursionOfGramMatrices, SquareOfTheSkewDiracBracket) {
  RandomGram random(12);
  for (int instance = 0; instance < 60; ++instance) {
    const std::size_t count = 2 * random.size(1, 3);
    const auto g = random.of(Symmetry::skew, count + 2);
    const auto w = g.block(0, 0, count, count);
    if (determinant(w) == Rational(0)) continue;
    const Rational bracket = dirac_brackets(g, count)(0, 1);
    ASSERT_EQ(bracket * bracket, determinant(g) / determinant(w));
    ASSERT_EQ(bracket, pfaffian(g) / pfaffian(w));
  }
  const auto& golden = golden_brackets().at("pfaffian");
  const auto g = golden_matrix(golden_brackets().at("skew").at("levels")[0]);
  EXPECT_EQ(pfaffian(g.block(0, 0, 6, 6)), fraction(golden.at("Pf_W6")));
  EXPECT_EQ(pfaffian(g), fraction(golden.at("Pf_W_fg")));
  EXPECT_EQ(dirac_brackets(g, 6)(0, 1), fraction(golden.at("dirac_fg")));
  EXPECT_EQ(determinant(g) / determinant(g.block(0, 0, 6, 6)), fraction(golden.at("square_check_3_18")));
}

// Proposition 4: of a Gram matrix B B^T every level is one again; the discriminant of its proof is not
// positive. A pseudo-metric bracket has none of this.
TEST(RecursionOfGramMatrices, SemimetricBracketsStaySo) {
  RandomGram random(13);
  int negative = 0;
  for (int instance = 0; instance < 60; ++instance) {
    const std::size_t count = random.size(1, 4), n = count + 3;
    const auto b = random.any(n, n + 1);
    const auto g = b * b.transposed();
    if (determinant(g.block(0, 0, count, count)) == Rational(0)) continue;
    const auto reduced = dirac_brackets(g, count);
    for (std::size_t k = 1; k <= 3; ++k) ASSERT_GE(determinant(reduced.block(0, 0, k, k)), Rational(0));
    for (std::size_t i = 1; i < n; ++i)
      ASSERT_LE(g(0, i) * g(0, i) - g(0, 0) * g(i, i), Rational(0));  // printed: >= 0
    ASSERT_TRUE(plain_recursion(g, Symmetry::symmetric, first_indices(count)).works);
    Matrix<Rational> signs = Matrix<Rational>::identity(n + 1);
    signs(0, 0) = -1;
    const auto pseudo = b * signs * b.transposed();
    if (determinant(pseudo.block(0, 0, count, count)) != Rational(0))
      negative += dirac_brackets(pseudo, count)(0, 0) < Rational(0);
  }
  EXPECT_GT(negative, 0);
}
}  // namespace
