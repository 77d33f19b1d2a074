// Random matrices of brackets and small rationals. Fixed seeds.
#pragma once

#include <random>
#include <vector>

#include <pfaff/core/bracket.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace pfaff::testing {

/// The fraction in another scalar, rounded once.
template <class T>
T as(const Rational& x) {
  if constexpr (std::is_same_v<T, Rational>) {
    return x;
  } else {
    return static_cast<T>(x);
  }
}
template <class T>
Matrix<T> as(const Matrix<Rational>& m) {
  Matrix<T> r(m.rows(), m.columns());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) r(i, j) = as<T>(m(i, j));
  return r;
}

class RandomGram {
 public:
  explicit RandomGram(unsigned seed) : random_(seed) {}

  std::size_t size(std::size_t low, std::size_t high) {
    return std::uniform_int_distribution<std::size_t>(low, high)(random_);
  }
  Rational number() {
    std::uniform_int_distribution<int> above(-12, 12), below(1, 4);
    const int numerator = above(random_);
    return Rational(numerator) / Rational(below(random_));
  }
  Matrix<Rational> any(std::size_t rows, std::size_t columns) {
    Matrix<Rational> m(rows, columns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) m(i, j) = number();
    return m;
  }
  /// n x n of the symmetry.
  Matrix<Rational> of(Symmetry symmetry, std::size_t n) {
    const Matrix<Rational> m = any(n, n);
    return symmetry == Symmetry::skew   ? m - m.transposed()
           : symmetry == Symmetry::none ? m
                                        : m + m.transposed();
  }
  /// The same with determinant not 0.
  Matrix<Rational> regular(Symmetry symmetry, std::size_t n) {
    for (;;) {
      Matrix<Rational> m = of(symmetry, n);
      if (determinant(m) != Rational(0)) return m;
    }
  }
  /// n x n of the symmetry with rank r (even where skew): B R B^T with random B, R.
  Matrix<Rational> of_rank(Symmetry symmetry, std::size_t n, std::size_t r) {
    const Matrix<Rational> b = independent(n, r);
    return b * regular(symmetry, r) * (symmetry == Symmetry::none ? independent(n, r) : b).transposed();
  }
  std::vector<std::size_t> shuffled(std::size_t n) {
    std::vector<std::size_t> order(n);
    for (std::size_t k = 0; k < n; ++k) order[k] = k;
    for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[size(0, k - 1)]);
    return order;
  }

 private:
  Matrix<Rational> independent(std::size_t n, std::size_t r) {
    for (;;) {
      const Matrix<Rational> b = any(n, r);
      if (determinant(b.transposed() * b) != Rational(0)) return b;
    }
  }
  std::mt19937 random_;
};

}  // namespace pfaff::testing
