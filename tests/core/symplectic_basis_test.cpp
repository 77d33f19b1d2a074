// Symplectic Gram-Schmidt: E^T K E is canonical in every scalar, and degenerate forms are recognized as such.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <pfaff/core/linear/symplectic_basis.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/quad.hpp>

namespace {
using namespace pfaff;

std::vector<double> random_form(std::mt19937_64& random, std::size_t n) {
  std::normal_distribution<double> number;
  std::vector<double> form(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) {
      form[i * n + j] = number(random);
      form[j * n + i] = -form[i * n + j];
    }
  return form;
}

double canonical(std::size_t i, std::size_t j, std::size_t n) {
  if (j == i + n / 2) return -1;
  return i == j + n / 2 ? 1 : 0;
}

// E^T K E - K_c, entry by entry.
template <class T>
std::vector<T> defect(const std::vector<T>& form, const std::vector<T>& basis, std::size_t n) {
  std::vector<T> result(n * n, T(0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      T sum(canonical(i, j, n));
      sum = -sum;
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b) sum = sum + basis[a * n + i] * form[a * n + b] * basis[b * n + j];
      result[i * n + j] = sum;
    }
  return result;
}

// |E|^T |K| |E|: what the entries of E^T K E are rounded to, in units of round-off.
template <class T>
T scale(const std::vector<T>& form, const std::vector<T>& basis, std::size_t n) {
  T worst(1);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      T sum(0);
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b) sum += abs(basis[a * n + i] * form[a * n + b] * basis[b * n + j]);
      worst = std::max(worst, sum);
    }
  return worst;
}

template <class T>
void expect_canonical(double round_off) {
  std::mt19937_64 random(61);
  for (std::size_t n = 2; n <= 12; n += 2)
    for (int trial = 0; trial < 10; ++trial) {
      const auto numbers = random_form(random, n);
      const PivotPairs pairs = choose_pivot_pairs(numbers, n);
      ASSERT_EQ(pairs.size(), n / 2);
      const std::vector<T> form(numbers.begin(), numbers.end());
      const auto basis = symplectic_basis<T>(form, pairs);
      const T bound = T(4 * static_cast<double>(n) * round_off) * scale(form, basis, n);
      for (const T& e : defect(form, basis, n)) EXPECT_LE(abs(e), bound) << n;
      // E^-1 E = 1, column by column.
      for (std::size_t column = 0; column < n; ++column) {
        std::vector<T> z(n);
        for (std::size_t i = 0; i < n; ++i) z[i] = basis[i * n + column];
        const auto y = symplectic_coordinates<T>(form, basis, z);
        for (std::size_t i = 0; i < n; ++i) EXPECT_LE(abs(y[i] - T(i == column ? 1 : 0)), bound) << n;
      }
      // Control: a form that differs by a millionth in one entry is not made canonical.
      auto other = form;
      other[1] = other[1] * T(1.000001);
      T largest(0);
      for (const T& e : defect(other, basis, n)) largest = std::max(largest, abs(e));
      EXPECT_GT(largest, bound * T(10));
    }
}

TEST(SymplecticBasis, MakesRandomFormsCanonicalInDouble) { expect_canonical<double>(0x1p-53); }
TEST(SymplecticBasis, MakesRandomFormsCanonicalInQuad) { expect_canonical<Quad>(0x1p-113); }

// K(t) = A + t B: E(t) keeps the identity to first order in t, so its derivative is right.
TEST(SymplecticBasis, DualsKeepTheIdentity) {
  std::mt19937_64 random(62);
  using D = Dual<Quad, 1>;
  for (std::size_t n = 2; n <= 12; n += 2) {
    const auto a = random_form(random, n), b = random_form(random, n);
    const PivotPairs pairs = choose_pivot_pairs(a, n);
    std::vector<D> form(n * n);
    for (std::size_t k = 0; k < n * n; ++k) {
      form[k].value = Quad(a[k]);
      form[k].derivative[0] = Quad(b[k]);
    }
    const auto basis = symplectic_basis<D>(form, pairs);
    Quad moves(0);
    for (const D& e : basis) moves = std::max(moves, abs(e.derivative[0]));
    EXPECT_GT(moves, Quad(0.01));
    // Pivots are the largest of their step, so the numbers that cancel stay below 1e4 at these sizes.
    for (const D& e : defect(form, basis, n)) {
      EXPECT_LE(abs(e.value), Quad(1e-29)) << n;
      EXPECT_LE(abs(e.derivative[0]), Quad(1e-28)) << n;
    }
  }
}

TEST(SymplecticBasis, DegenerateFormsHaveNoPivots) {
  std::mt19937_64 random(63);
  EXPECT_TRUE(choose_pivot_pairs(random_form(random, 3), 3).empty());
  EXPECT_TRUE(choose_pivot_pairs(std::vector<double>(16), 4).empty());
  EXPECT_TRUE(choose_pivot_pairs(std::vector<double>{0, NAN, NAN, 0}, 2).empty());
  for (std::size_t n = 4; n <= 12; n += 2) {
    // u v^T - v u^T has rank 2, up to the rounding of its products.
    std::normal_distribution<double> number;
    std::vector<double> u(n), v(n), form(n * n);
    for (double& x : u) x = number(random);
    for (double& x : v) x = number(random);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) form[i * n + j] = u[i] * v[j] - v[i] * u[j];
    EXPECT_TRUE(choose_pivot_pairs(form, n).empty()) << n;
  }
  // Units do not make a form degenerate.
  std::vector<double> scaled(16);
  scaled[1] = 1e20, scaled[4] = -1e20, scaled[11] = 1e-20, scaled[14] = -1e-20;
  EXPECT_EQ(choose_pivot_pairs(scaled, 4).size(), 2U);
}

}  // namespace
