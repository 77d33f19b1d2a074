// The matrix fractional transformation between the Jacobians of K-symplectic maps and symmetric matrices
// (su-qin section 3, (33)-(43)).
//
// alpha: (z', z) -> (w^, w) takes a pair of states, new and old, n numbers each, to another pair. Its
// Jacobian in n x n blocks is alpha_* = [[A, B], [C, D]], and it is required to satisfy
//
//   alpha_*^T J alpha_* = diag(K, -K0),   J = [[0, I], [-I, 0]], K = K(z', t), K0 = K(z, t0)   (34)
//
// (the middle matrix printed in (35) is another one, and (95) does not satisfy it). A map z -> z' with
// Jacobian M then becomes a map w -> w^ with Jacobian
//
//   N = sigma(M) = (A M + B)(C M + D)^-1                                                         (36), (42)
//
// where C M + D is regular, and with X = A M + B, Y = C M + D
//
//   Y^T (N^T - N) Y = X^T Y - Y^T X = M^T K M - K0:
//
// N is symmetric exactly where M is K-symplectic. The inverse is the same formula with the blocks of
// alpha_*^-1.
#pragma once

#include <array>

#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// The blocks of a Jacobian [[a, b], [c, d]], n x n each, and the transformation they make of n x n matrices.
template <class T>
struct FractionalTransformation {
  Matrix<T> a, b, c, d;

  /// The blocks of a 2n x 2n matrix.
  static FractionalTransformation of(const Matrix<T>& jacobian) {
    const std::size_t n = jacobian.rows() / 2;
    return {jacobian.block(0, 0, n, n), jacobian.block(0, n, n, n), jacobian.block(n, 0, n, n),
            jacobian.block(n, n, n, n)};
  }
  [[nodiscard]] std::size_t size() const { return a.rows(); }
  [[nodiscard]] Matrix<T> jacobian() const {
    const std::size_t n = size();
    Matrix<T> m(2 * n, 2 * n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        m(i, j) = a(i, j);
        m(i, n + j) = b(i, j);
        m(n + i, j) = c(i, j);
        m(n + i, n + j) = d(i, j);
      }
    return m;
  }

  /// C M + D, whose regularity is the transversality condition (37).
  [[nodiscard]] Matrix<T> denominator(const Matrix<T>& m) const { return c * m + d; }
  /// sigma(M); not-a-number where C M + D is singular.
  [[nodiscard]] Matrix<T> operator()(const Matrix<T>& m) const {
    return (a * m + b) * inverse(denominator(m));
  }
  /// M = (A - N C)^-1 (N D - B): back from N = sigma(M) without the inverse blocks.
  [[nodiscard]] Matrix<T> solved_for(const Matrix<T>& n) const { return inverse(a - n * c) * (n * d - b); }

  /// The blocks of alpha_*^-1 from (34) alone, without inverting alpha_*:
  /// [[-K^-1 C^T, K^-1 A^T], [K0^-1 D^T, -K0^-1 B^T]]. Wrong where (34) does not hold with factor +1.
  [[nodiscard]] FractionalTransformation inverse_blocks(const Matrix<T>& k, const Matrix<T>& k0) const {
    const Matrix<T> pi = inverse(k), pi0 = inverse(k0);
    return {-(pi * c.transposed()), pi * a.transposed(), pi0 * d.transposed(), -(pi0 * b.transposed())};
  }
};

/// The determinants |C M + D|, |M C' - A'|, |C' N + D'|, |N C - A| of (38), primes for the blocks of
/// alpha_*^-1, N = sigma(M). The first is |alpha_*| times the second, the third its inverse, the fourth the
/// inverse of the second: none of them vanishes where one does not.
template <class T>
std::array<T, 4> transversality(const FractionalTransformation<T>& alpha,
                                const FractionalTransformation<T>& inverse_alpha, const Matrix<T>& m,
                                const Matrix<T>& n) {
  return {determinant(alpha.denominator(m)), determinant(m * inverse_alpha.c - inverse_alpha.a),
          determinant(inverse_alpha.denominator(n)), determinant(n * alpha.c - alpha.a)};
}

/// diag(K, -K0), the structure of pairs (z', z) for which graphs of K-symplectic maps are Lagrangian (22).
template <class T>
Matrix<T> pair_structure(const Matrix<T>& k, const Matrix<T>& k0) {
  const std::size_t n = k.rows();
  Matrix<T> m(2 * n, 2 * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      m(i, j) = k(i, j);
      m(n + i, n + j) = -k0(i, j);
    }
  return m;
}

/// J = [[0, I], [-I, 0]] with blocks of size `half`.
template <class T>
Matrix<T> canonical_structure(std::size_t half) {
  Matrix<T> m(2 * half, 2 * half);
  for (std::size_t i = 0; i < half; ++i) {
    m(i, half + i) = T(1);
    m(half + i, i) = T(-1);
  }
  return m;
}

/// A^T S A.
template <class T>
Matrix<T> pulled_back(const Matrix<T>& s, const Matrix<T>& a) {
  return a.transposed() * s * a;
}

}  // namespace pfaff
