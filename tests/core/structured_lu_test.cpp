// L D U factorizations of matrices that are not symmetric, on every structure.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/core/tape/replay.hpp>

#include "../eigen/decompositions.hpp"
#include "structured_samples.hpp"

namespace {
using namespace pfaff;
using namespace pfaff::testing;

TEST(StructuredLU, ExactOverRationals) {
  std::mt19937_64 random(61);
  for (const Sample& sample : samples(random)) {
    StructuredLU<Rational> matrix(sample.pattern);
    int regular = 0, transposed = 0;
    for (int trial = 0; trial < 4; ++trial) {
      const Entries e = Entries::random(*sample.pattern, trial % 2 == 0 ? 1 : -8, random);
      e.fill(matrix);
      if (matrix.factor() == Status::singular) continue;
      ++regular;
      const auto b1 = random_integers<Rational>(sample.pattern->rows(), random),
                 b2 = random_integers<Rational>(sample.pattern->rows(), random);
      std::vector<Rational> x(b1.size()), y = b2, z = b2;
      matrix.solve(b1.data(), x.data(), y.data(), y.data());
      for (const auto& [solution, right] : {std::pair(x, b1), std::pair(y, b2)})
        for (const Rational& r : e.residual(*sample.pattern, solution, right))
          EXPECT_EQ(r, Rational(0)) << sample.name;
      EXPECT_EQ(matrix.factor_and_solve(z.data(), z.data()), Status::converged);
      EXPECT_EQ(y, z);
      // Control: the transposed matrix is another one.
      Entries other = e;
      std::swap(other.lower, other.upper);
      const auto r = other.residual(*sample.pattern, x, b1);
      transposed += std::any_of(r.begin(), r.end(), [](const Rational& v) { return v != Rational(0); });
    }
    EXPECT_GE(regular, 2) << sample.name;
    if (!sample.pattern->couplings().empty()) {
      EXPECT_GE(transposed, 1) << sample.name;
    }
  }
}

// A residual of round-off times growth, as for L D L^T.
template <class T>
void lu_residuals_are_round_off() {
  std::mt19937_64 random(62);
  for (const Sample& sample : samples(random)) {
    StructuredLU<T> matrix(sample.pattern);
    for (int trial = 0; trial < 20; ++trial) {
      const Entries e = Entries::random(*sample.pattern, trial % 2 == 0 ? 8 : -8, random);
      e.fill(matrix);
      const auto b = random_integers<T>(sample.pattern->rows(), random);
      std::vector<T> x(b.size()), y(b.size());
      if (matrix.factor() == Status::singular) continue;
      matrix.solve(b.data(), x.data());
      T sum(0);
      for (const T& v : x) sum = sum + abs(v);
      const T bound =
          T(4 * static_cast<int>(b.size() + 2)) * unit_roundoff<T>() * matrix.growth() * T(e.largest()) * sum;
      for (const T& r : e.residual(*sample.pattern, x, b)) EXPECT_LE(abs(r), bound) << sample.name;
      matrix.factor_and_solve(b.data(), y.data());
      EXPECT_EQ(x, y) << sample.name;
    }
  }
}
TEST(StructuredLU, ResidualsAreRoundOffInDouble) { lu_residuals_are_round_off<double>(); }
TEST(StructuredLU, ResidualsAreRoundOffInQuad) { lu_residuals_are_round_off<Quad>(); }

TEST(StructuredLU, SolvesLikeEigen) {
  std::mt19937_64 random(63);
  for (const Sample& sample : samples(random)) {
    const auto rows = static_cast<int>(sample.pattern->rows());
    Entries e = Entries::random(*sample.pattern, 8, random);
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(rows, rows);
    for (int i = 0; i < rows; ++i) a(i, i) = e.diagonal[static_cast<std::size_t>(i)] += 8 * rows;
    for (std::size_t c = 0; c < e.lower.size(); ++c) {
      const auto i = static_cast<int>(sample.pattern->couplings()[c].first),
                 j = static_cast<int>(sample.pattern->couplings()[c].second);
      a(j, i) = e.lower[c];
      a(i, j) = e.upper[c];
    }
    StructuredLU<double> matrix(sample.pattern);
    e.fill(matrix);
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(rows, -1, 2), expected = solved_by_eigen(a, b);
    Eigen::VectorXd x(rows);
    ASSERT_EQ(matrix.factor_and_solve(b.data(), x.data()), Status::converged);
    // Diagonally dominant: the condition is below 10.
    EXPECT_LE((x - expected).norm(), 1e-14 * expected.norm()) << sample.name;
  }
}

TEST(StructuredLU, IsTheSymmetricFactorisationOfASymmetricMatrix) {
  std::mt19937_64 random(64);
  for (const Sample& sample : samples(random)) {
    const Entries e = Entries::positive(*sample.pattern, random);
    StructuredLDLT<Quad> symmetric(sample.pattern);
    StructuredLU<Quad> matrix(sample.pattern);
    e.fill(symmetric);
    e.fill(matrix);
    const auto b = random_integers<Quad>(sample.pattern->rows(), random);
    std::vector<Quad> x(b.size()), y(b.size());
    symmetric.factor_and_solve(b.data(), x.data());
    matrix.factor_and_solve(b.data(), y.data());
    EXPECT_EQ(x, y) << sample.name;
  }
}

// The brackets of constraints among themselves: a zero diagonal, so that the first pivot vanishes whatever
// the matrix is.
TEST(StructuredLU, SkewMatricesHaveNoPivots) {
  const auto pattern = std::make_shared<const SymmetricPattern>(SymmetricPattern::path(4));
  StructuredLU<double> matrix(pattern);
  for (std::size_t c = 0; c < 3; ++c) {
    matrix.lower()[c] = -1;
    matrix.upper()[c] = 1;
  }
  EXPECT_EQ(matrix.factor(), Status::singular);
  // Control: the identity plus a skew matrix is regular, and no pivot is below 1.
  std::fill_n(matrix.diagonal(), 4, 1.0);
  EXPECT_EQ(matrix.factor(), Status::converged);
  // The middle row: 1 + 1/2 + 1 is its pivot, and 1/2 + 1 was added to it.
  EXPECT_EQ(matrix.growth(), 4);
}

TEST(StructuredLU, RecordedFormulasGiveTheSameBits) {
  std::mt19937_64 random(65);
  for (const Sample& sample : samples(random)) {
    const std::size_t rows = sample.pattern->rows(), couplings = sample.pattern->couplings().size();
    const auto formula = [&]<class N>(std::span<const N> z, std::span<N> x) {
      StructuredLU<N> matrix(sample.pattern);
      const N* from = z.data();
      std::copy_n(from, rows, matrix.diagonal());
      std::copy_n(from + rows, couplings, matrix.lower());
      std::copy_n(from + rows + couplings, couplings, matrix.upper());
      EXPECT_EQ(matrix.factor(), Status::converged);
      matrix.solve(from + rows + 2 * couplings, x.data());
    };
    Replay<double> replay(std::make_shared<const Tape>(
        record(static_cast<int>(2 * (rows + couplings)), static_cast<int>(rows),
               [&](const Recorded&, std::span<const Recorded> z, std::span<Recorded> x) { formula(z, x); })));
    std::vector<double> z = random_integers<double>(2 * (rows + couplings), random), x(rows), expected(rows);
    for (double& v : z) v = v / 3;
    for (std::size_t i = 0; i < rows; ++i) z[i] += 40;
    formula(std::span<const double>(z), std::span<double>(expected));
    replay(0, z.data(), x.data());
    EXPECT_EQ(x, expected) << sample.name;
  }
}

TEST(StructuredLU, DualsCarryDerivativesThrough) {
  using D = Dual<double, 4>;
  std::mt19937_64 random(66);
  for (const Sample& sample : samples(random)) {
    const std::size_t rows = sample.pattern->rows();
    Entries e = Entries::random(*sample.pattern, 8, random);
    for (int& d : e.diagonal) d += 8 * static_cast<int>(rows);
    const Entries slope = Entries::random(*sample.pattern, -8, random);
    StructuredLU<D> matrix(sample.pattern);
    StructuredLU<double> plain(sample.pattern);
    e.fill(matrix);
    e.fill(plain);
    for (std::size_t i = 0; i < rows; ++i) matrix.diagonal()[i].derivative[2] = slope.diagonal[i];
    for (std::size_t c = 0; c < e.lower.size(); ++c) {
      matrix.lower()[c].derivative[2] = slope.lower[c];
      matrix.upper()[c].derivative[2] = slope.upper[c];
    }
    const auto b = random_integers<double>(rows, random);
    std::vector<D> x(b.begin(), b.end());
    ASSERT_EQ(matrix.factor_and_solve(x.data(), x.data()), Status::converged);
    ASSERT_EQ(plain.factor(), Status::converged);
    std::vector<double> expected(rows);
    plain.solve(b.data(), expected.data());
    // A x' = -A' x.
    std::vector<double> derivative = slope.residual(*sample.pattern, expected, std::vector<double>(rows));
    for (double& r : derivative) r = -r;
    plain.solve(derivative.data(), derivative.data());
    for (std::size_t i = 0; i < rows; ++i) {
      EXPECT_EQ(x[i].value, expected[i]);
      EXPECT_NEAR(x[i].derivative[2], derivative[i], 1e-14);
    }
  }
}

}  // namespace
