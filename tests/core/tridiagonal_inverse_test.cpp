// The closed forms of the inverse of a tridiagonal matrix: reference values of a chain of six beads, exact
// identities over rationals, and chains so long that minors overflow.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <pfaff/bench/runner/json.hpp>
#include <random>

#include <pfaff/core/linear/structured_ldlt.hpp>
#include <pfaff/core/linear/tridiagonal_inverse.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace {
using namespace pfaff;

template <class T>
Tridiagonal<T> random_matrix(std::size_t rows, int smallest_diagonal, std::mt19937_64& random) {
  Tridiagonal<T> s;
  for (std::size_t k = 0; k < rows; ++k) {
    s.diagonal.push_back(T(smallest_diagonal + static_cast<int>(random() % 9)) / T(3));
    const int coupling = 1 + static_cast<int>(random() % 4);
    if (k > 0) s.couplings.push_back(T(random() % 2 == 0 ? coupling : -coupling) / T(3));
  }
  return s;
}
template <class T>
T matrix_distance(const Matrix<T>& a, const Matrix<T>& b) {
  return largest(a - b);
}
template <class T>
T error_of(const Tridiagonal<T>& s, const Matrix<T>& inverse) {
  return matrix_distance(s.dense() * inverse, Matrix<T>::identity(s.rows()));
}

// Reference values, computed with 40 digits.
template <class T>
void expect_reference_values(double tolerance) {
  const auto all = nlohmann::json::parse(std::ifstream(std::string(PFAFF_GOLDEN) + "/chain6_3d.json"));
  const auto& golden = all.at("appendix_C_for_consistent_S");
  const auto number = [](const nlohmann::json& j) {
    Quad x;
    EXPECT_TRUE(parse(j.get<std::string>(), x));
    return static_cast<T>(x);
  };
  const auto numbers = [&](const char* name) {
    std::vector<T> result;
    for (const auto& j : golden.at(name)) result.push_back(number(j));
    return result;
  };
  const auto expect = [&](const std::vector<T>& computed, const char* name) {
    const std::vector<T> expected = numbers(name);
    ASSERT_EQ(computed.size(), expected.size()) << name;
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_LE(abs(computed[k] - expected[k]), T(tolerance) * abs(expected[k])) << name << " " << k;
  };
  const Tridiagonal<T> s{numbers("c"), numbers("b")};
  expect(leading_minors(s), "leading_minors_0_to_K");
  expect(trailing_minors(s), "trailing_minors_S_jplus1_to_K_for_j_0_to_K");
  EXPECT_LE(abs(leading_minors(s).back() - number(golden.at("det_S"))), T(20 * tolerance));
  const OnePair<T> pair = one_pair_inverse(s);
  expect(pair.left, "u");
  expect(pair.right, "w");
  const InverseFactor<T> factor = inverse_factor(s);
  expect(factor.x, "x_1_to_K");
  expect(factor.y, "y_1_to_Kminus1");
  expect(factor.z, "z_0_to_Kminus1");
  expect(factor.beta, "beta_1_to_Kminus1");
  expect(normalised_couplings(s), "beta_1_to_Kminus1");
  const Matrix<T> u = factor.dense();
  for (std::size_t i = 0; i < s.rows(); ++i)
    for (std::size_t j = 0; j < s.rows(); ++j)
      EXPECT_LE(abs(u(i, j) - number(golden.at("U").at(i).at(j))), T(tolerance));
  // The condition of S is below 10, its entries of order 1.
  for (const Matrix<T>& inverse : {inverse_by_minors(s), pair.dense(), factor.inverse()})
    EXPECT_LE(error_of(s, inverse), T(10 * tolerance));
  EXPECT_LE(matrix_distance(u.transposed() * s.dense() * u, Matrix<T>::identity(s.rows())),
            T(10 * tolerance));
}
// A few dozen roundings each.
TEST(TridiagonalInverse, ReferenceValuesInDouble) { expect_reference_values<double>(40 * 0x1p-53); }
TEST(TridiagonalInverse, ReferenceValuesInQuad) { expect_reference_values<Quad>(40 * 0x1p-113); }

TEST(TridiagonalInverse, MinorsAreDeterminants) {
  std::mt19937_64 random(91);
  for (std::size_t rows = 1; rows <= 7; ++rows) {
    const auto s = random_matrix<Rational>(rows, -4, random);
    const Matrix<Rational> dense = s.dense();
    const auto leading = leading_minors(s), trailing = trailing_minors(s);
    for (std::size_t k = 0; k <= rows; ++k) {
      EXPECT_EQ(leading[k], determinant(dense.block(0, 0, k, k)));
      EXPECT_EQ(trailing[k], determinant(dense.block(k, k, rows - k, rows - k)));
      const auto block = block_minors(s, k);
      ASSERT_EQ(block.size(), rows - k + 1);
      for (std::size_t i = 0; i < block.size(); ++i)
        EXPECT_EQ(block[i], determinant(dense.block(k, k, i, i)));
    }
  }
}

TEST(TridiagonalInverse, ClosedFormsAreExactOverRationals) {
  std::mt19937_64 random(92);
  int regular = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t rows = 1 + static_cast<std::size_t>(trial) % 9;
    // Positive definite or not.
    const auto s = random_matrix<Rational>(rows, trial % 2 == 0 ? 9 : -4, random);
    if (leading_minors(s).back() == Rational(0)) continue;
    ++regular;
    const Matrix<Rational> expected = inverse(s.dense());
    EXPECT_EQ(matrix_distance(inverse_by_minors(s), expected), Rational(0));
    const OnePair<Rational> pair = one_pair_inverse(s);
    EXPECT_EQ(matrix_distance(pair.dense(), expected), Rational(0));
    // There and back.
    const auto again = tridiagonal_inverse(pair);
    EXPECT_EQ(again.diagonal, s.diagonal);
    EXPECT_EQ(again.couplings, s.couplings);
  }
  EXPECT_GT(regular, 50);
}

TEST(TridiagonalInverse, OnePairMatricesHaveTridiagonalInverses) {
  std::mt19937_64 random(93);
  for (std::size_t rows = 1; rows <= 8; ++rows) {
    OnePair<Rational> pair;
    // left / right rises, so that no e_k vanishes.
    for (std::size_t k = 0; k < rows; ++k) {
      pair.right.push_back(Rational(1 + static_cast<int>(random() % 9)));
      pair.left.push_back(pair.right.back() * Rational(static_cast<int>(3 * k + 1 + random() % 3)) /
                          Rational(7));
    }
    const auto s = tridiagonal_inverse(pair);
    EXPECT_EQ(matrix_distance(s.dense(), inverse(pair.dense())), Rational(0));
  }
  // Control: the inverse of a matrix that is no one-pair matrix is full.
  Matrix<Rational> m(3, 3);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m(i, j) = Rational(i == j ? 2 : 1);
  EXPECT_NE(inverse(m)(0, 2), Rational(0));
}

// As printed, (C.5) starts from d_0 = 0: minors of empty blocks are lost and with them the corners.
TEST(TridiagonalInverse, MinorsOfEmptyBlocksAreNotZero) {
  std::mt19937_64 random(94);
  const std::size_t rows = 6;
  const auto s = random_matrix<Rational>(rows, 9, random);
  const auto by_blocks = [&](const Rational& empty) {
    const auto minors = [&](std::size_t first) {
      std::vector<Rational> d{empty};
      for (std::size_t k = first; k < rows; ++k) {
        Rational minor = k == first ? s.diagonal[k] : s.diagonal[k] * d.back();
        if (k > first) minor = minor - s.couplings[k - 1] * s.couplings[k - 1] * d[d.size() - 2];
        d.push_back(minor);
      }
      return d;
    };
    Matrix<Rational> m(rows, rows);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = i; j < rows; ++j) {
        Rational product = minors(0)[i] * minors(j + 1)[rows - j - 1] / minors(0)[rows];
        for (std::size_t k = i; k < j; ++k) product = -(product * s.couplings[k]);
        m(i, j) = m(j, i) = product;
      }
    return m;
  };
  EXPECT_EQ(error_of(s, by_blocks(Rational(1))), Rational(0));
  EXPECT_GT(error_of(s, by_blocks(Rational(0))), Rational(Real::fraction(1, 10)));
}

// U^T S U = 1 and U U^T = S^-1, in double and quad, for chains up to 60 rows.
template <class T>
void factor_is_of_the_inverse() {
  std::mt19937_64 random(95);
  for (std::size_t rows = 1; rows <= 60; rows += 1 + rows / 4) {
    const auto s = random_matrix<T>(rows, 9, random);
    const InverseFactor<T> factor = inverse_factor(s);
    const Matrix<T> u = factor.dense();
    // Diagonally dominant by 1/3 at least, entries below 6: the condition is below 60.
    const T tolerance = T(400) * unit_roundoff<T>();
    EXPECT_LE(matrix_distance(u.transposed() * s.dense() * u, Matrix<T>::identity(rows)), tolerance);
    EXPECT_LE(error_of(s, u * u.transposed()), tolerance);
    EXPECT_LE(matrix_distance(factor.inverse(), u * u.transposed()), tolerance);
    if (rows == 1) continue;
    const std::vector<T> beta = normalised_couplings(s);
    ASSERT_EQ(beta.size(), factor.beta.size());
    for (std::size_t k = 0; k < beta.size(); ++k)
      EXPECT_LE(abs(beta[k] - factor.beta[k]), tolerance * abs(beta[k]));
    // Control: as printed, the sum of (C.16) ends at K - 1 and the last row of U is missing.
    Matrix<T> printed = u;
    for (std::size_t i = 0; i < rows; ++i) printed(i, rows - 1) = T(0);
    EXPECT_GT(error_of(s, printed * printed.transposed()), T(1) / T(2));
  }
}
TEST(TridiagonalInverse, FactorOfTheInverseInDouble) { factor_is_of_the_inverse<double>(); }
TEST(TridiagonalInverse, FactorOfTheInverseInQuad) { factor_is_of_the_inverse<Quad>(); }

// Second differences plus 2: minors grow by 2 + sqrt(3) a row and pass 2^1024 after 538 rows, though the
// entries of the inverse are below 1/2 all the time. Solving does not notice.
TEST(TridiagonalInverse, MinorsOfLongChainsOverflow) {
  const auto matrix = [](std::size_t rows) {
    return Tridiagonal<double>{std::vector<double>(rows, 4), std::vector<double>(rows - 1, -1)};
  };
  const auto finite = [](const Matrix<double>& m) { return std::isfinite(largest(m)); };
  EXPECT_TRUE(finite(inverse_by_minors(matrix(500))));
  EXPECT_LE(error_of(matrix(500), inverse_by_minors(matrix(500))), 1e-12);
  EXPECT_FALSE(finite(inverse_by_minors(matrix(560))));
  EXPECT_FALSE(finite(one_pair_inverse(matrix(560)).dense()));
  std::size_t last = 0;
  const auto minors = leading_minors(matrix(560));
  while (std::isfinite(minors[last + 1])) ++last;
  EXPECT_EQ(last, static_cast<std::size_t>(1024 * std::log(2) / std::log(2 + std::sqrt(3.0))));
  // Quad has sixteen times the exponents.
  const auto in_quad =
      leading_minors(Tridiagonal<Quad>{std::vector<Quad>(8700, Quad(4)), std::vector<Quad>(8699, Quad(-1))});
  for (last = 0; isfinite(in_quad[last + 1]);) ++last;
  EXPECT_EQ(last, static_cast<std::size_t>(16384 * std::log(2) / std::log(2 + std::sqrt(3.0))));
  // The factor of the inverse multiplies ratios, and L D L^T needs no products at all.
  EXPECT_LE(error_of(matrix(560), inverse_factor(matrix(560)).inverse()), 1e-14);
  StructuredLDLT<double> factors(std::make_shared<const SymmetricPattern>(SymmetricPattern::path(560)));
  std::fill_n(factors.diagonal(), 560, 4.0);
  std::fill_n(factors.couplings(), 559, -1.0);
  std::vector<double> x(560, 1.0);
  ASSERT_EQ(factors.factor_and_solve(x.data(), x.data()), Status::converged);
  EXPECT_NEAR(x[280], 0.5, 1e-15);
}

}  // namespace
