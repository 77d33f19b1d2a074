// LU against Eigen, with rows of very different scale, singular matrices, and right-hand sides of richer
// scalars than the matrix.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/dual.hpp>

#include "../eigen/decompositions.hpp"

namespace {
using namespace pfaff;
using pfaff::testing::condition_of;
using pfaff::testing::solved_by_eigen;

template <class T>
LU<T> copy_of(const Eigen::MatrixXd& a) {
  LU<T> lu(static_cast<std::size_t>(a.rows()));
  for (int i = 0; i < a.rows(); ++i)
    for (int j = 0; j < a.cols(); ++j)
      lu(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) = T(a(i, j));
  return lu;
}

TEST(LU, SolvesLikeEigen) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 1 + trial % 8;
    const auto size = static_cast<std::size_t>(n);
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(random); });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n, [&] { return number(random); });
    const Eigen::VectorXd expected = solved_by_eigen(a, b);
    const double condition = condition_of(a);

    LU<double> lu = copy_of<double>(a);
    ASSERT_TRUE(lu.factor());
    std::vector<double> x(size);
    lu.solve(b.data(), x.data());
    for (int i = 0; i < n; ++i)
      EXPECT_NEAR(x[static_cast<std::size_t>(i)], expected(i), 4e-15 * condition * expected.norm());

    // In quad the residual is a few units of its round-off.
    LU<Quad> fine = copy_of<Quad>(a);
    ASSERT_TRUE(fine.factor());
    std::vector<Quad> right(b.data(), b.data() + n), y(size);
    fine.solve(right.data(), y.data());
    for (int i = 0; i < n; ++i) {
      Quad residual = right[static_cast<std::size_t>(i)], terms(1);
      for (int j = 0; j < n; ++j) {
        residual -= Quad(a(i, j)) * y[static_cast<std::size_t>(j)];
        terms += abs(Quad(a(i, j)) * y[static_cast<std::size_t>(j)]);
      }
      EXPECT_LE(abs(residual), Quad(1e-32) * terms);
    }
  }
}

TEST(LU, RowScalesDoNotMatter) {
  // Rows scaled by 10^-20 .. 10^20, the solution must be as good as that of the balanced matrix:
  // equilibration makes the choice of pivots independent of the scales. Powers of two, so that scaling itself
  // does not round.
  std::mt19937_64 random(9);
  std::normal_distribution<double> number;
  std::uniform_int_distribution<int> exponent(-66, 66);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 2 + trial % 5;
    const auto size = static_cast<std::size_t>(n);
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(random); });
    const Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(n, [&] { return number(random); });
    Eigen::MatrixXd scaled = a;
    Eigen::VectorXd right = b;
    for (int i = 0; i < n; ++i) {
      const double scale = std::ldexp(1.0, exponent(random));
      scaled.row(i) *= scale;
      right(i) *= scale;
    }
    LU<double> balanced = copy_of<double>(a), lu = copy_of<double>(scaled);
    ASSERT_TRUE(balanced.factor() && lu.factor());
    std::vector<double> x(size), expected(size);
    balanced.solve(b.data(), expected.data());
    lu.solve(right.data(), x.data());
    for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(x[i], expected[i]) << trial;
  }
  // [[2^-70, 1], [1, 1]] x = (1, 2) with the first row times 2^100.
  const double s = std::ldexp(1.0, 100);
  Eigen::MatrixXd a(2, 2);
  a << std::ldexp(s, -70), s, 1, 1;
  const Eigen::Vector2d b(s, 2);
  LU<double> lu = copy_of<double>(a);
  ASSERT_TRUE(lu.factor());
  double x[2];
  lu.solve(b.data(), x);
  EXPECT_EQ(x[0], 1);
  EXPECT_EQ(x[1], 1);
  // Control: pivots chosen by size alone lose every digit of x_1.
  EXPECT_NEAR(pfaff::testing::solved_with_partial_pivoting(a, b)(0), 0, 1e-3);
}

TEST(LU, SaysWhenAMatrixIsSingular) {
  const auto factors = [](std::initializer_list<double> elements) {
    const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(elements.size()))));
    LU<double> lu(n);
    std::size_t k = 0;
    for (const double x : elements) {
      lu(k / n, k % n) = x;
      ++k;
    }
    return lu.factor();
  };
  EXPECT_TRUE(factors({0, 1, 1, 0}));
  EXPECT_TRUE(factors({1e-300, 0, 0, 1e300}));
  EXPECT_FALSE(factors({0}));
  EXPECT_FALSE(factors({1, 2, 2, 4}));
  EXPECT_FALSE(factors({1, 2, 0, 0}));
  EXPECT_FALSE(factors({0, 2, 0, 1}));
  EXPECT_FALSE(factors({1, 2, 3, 4, 5, 6, 5, 7, 9}));
  EXPECT_FALSE(factors({NAN, NAN, NAN, NAN}));
  EXPECT_FALSE(factors({NAN, 1, NAN, 1}));
  EXPECT_FALSE(factors({INFINITY, 1, 1, 1}));
}

TEST(LU, CanBeFilledAndFactoredAgain) {
  LU<double> lu(2);
  for (const double d : {1.0, 0.0, 3.0}) {
    lu(0, 0) = d, lu(0, 1) = 1, lu(1, 0) = d, lu(1, 1) = 2;
    ASSERT_EQ(lu.factor(), d != 0);
    if (d == 0) continue;
    const double b[] = {2, 3};
    double x[2];
    lu.solve(b, x);
    EXPECT_DOUBLE_EQ(x[0], 1 / d);
    EXPECT_DOUBLE_EQ(x[1], 1);
  }
}

// A plain matrix against right-hand sides with derivatives, and a matrix with derivatives.
TEST(LU, DualsCarryDerivativesThrough) {
  std::mt19937_64 random(10);
  std::normal_distribution<double> number;
  using D = Dual<double, 2>;
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 4;
    Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(random); });
    a.diagonal().array() += trial % 2 == 0 ? 5 : 0;
    const Eigen::MatrixXd da = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return number(random); });
    const Eigen::MatrixXd b =
        Eigen::MatrixXd::NullaryExpr(n, 3, [&] { return number(random); });  // value, slopes
    const Eigen::MatrixXd x = solved_by_eigen(a, b);
    std::vector<D> right(n), y(n);
    for (int i = 0; i < n; ++i) {
      auto& e = right[static_cast<std::size_t>(i)];
      e.value = b(i, 0);
      e.derivative = {b(i, 1), b(i, 2)};
    }
    const double bound = 1e-14 * std::pow(condition_of(a), 2) * (1 + x.norm());
    LU<double> plain = copy_of<double>(a);
    ASSERT_TRUE(plain.factor());
    plain.solve(right.data(), y.data());
    for (int i = 0; i < n; ++i) {
      const D& e = y[static_cast<std::size_t>(i)];
      EXPECT_NEAR(e.value, x(i, 0), bound);
      EXPECT_NEAR(e.derivative[0], x(i, 1), bound);
      EXPECT_NEAR(e.derivative[1], x(i, 2), bound);
    }
    LU<D> full = copy_of<D>(a);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        full(static_cast<std::size_t>(i), static_cast<std::size_t>(j)).derivative[1] = da(i, j);
    ASSERT_TRUE(full.factor());
    full.solve(right.data(), y.data());
    const Eigen::VectorXd slope = solved_by_eigen(a, b.col(2) - da.lazyProduct(x.col(0)));
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(y[static_cast<std::size_t>(i)].derivative[0], x(i, 1), bound);
      EXPECT_NEAR(y[static_cast<std::size_t>(i)].derivative[1], slope(i), bound * (1 + slope.norm()));
    }
  }
}

}  // namespace
