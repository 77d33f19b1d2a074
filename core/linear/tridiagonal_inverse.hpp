// The inverse of a symmetric tridiagonal matrix in closed form: by minors, as a one-pair matrix, and by an
// upper triangular factor.
//
// These are references for small systems, exact over rationals where no root is taken. They do not serve
// larger ones: the inverse is full and has K^2 entries, and minors grow like the product of all pivots, so
// that a chain of a few hundred rows leaves the range of double (and one of a few thousand that of quad).
// Systems are solved by StructuredLDLT.
//
// Rows are counted from 0 here and from 1 in the reference, nguyen-turski, section 4 and appendix C.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// A symmetric tridiagonal matrix with K rows: K diagonal entries (c) and K - 1 couplings of neighbours (b).
template <class T>
struct Tridiagonal {
  std::vector<T> diagonal, couplings;

  [[nodiscard]] std::size_t rows() const { return diagonal.size(); }
  [[nodiscard]] Matrix<T> dense() const {
    Matrix<T> m(rows(), rows());
    for (std::size_t k = 0; k < rows(); ++k) m(k, k) = diagonal[k];
    for (std::size_t k = 0; k + 1 < rows(); ++k) m(k, k + 1) = m(k + 1, k) = couplings[k];
    return m;
  }
};

/// The determinants of the blocks of rows first .. first + k - 1, for k = 0 .. K - first: d_k^(first + 1)
/// of nguyen-turski (C.5), with 1 for the empty block, where the reference prints 0.
template <class T>
std::vector<T> block_minors(const Tridiagonal<T>& s, std::size_t first) {
  std::vector<T> d{T(1)};
  for (std::size_t k = first; k < s.rows(); ++k) {
    T minor = s.diagonal[k] * d.back();
    if (k > first) minor = minor - s.couplings[k - 1] * s.couplings[k - 1] * d[d.size() - 2];
    d.push_back(minor);
  }
  return d;
}

/// The determinants of the first k rows and columns, k = 0 .. K (nguyen-turski (C.3)). The last is that of
/// the matrix.
template <class T>
std::vector<T> leading_minors(const Tridiagonal<T>& s) {
  return block_minors(s, 0);
}

/// The determinants of the rows and columns from k on, k = 0 .. K.
template <class T>
std::vector<T> trailing_minors(const Tridiagonal<T>& s) {
  Tridiagonal<T> reversed = s;
  std::reverse(reversed.diagonal.begin(), reversed.diagonal.end());
  std::reverse(reversed.couplings.begin(), reversed.couplings.end());
  std::vector<T> minors = leading_minors(reversed);
  std::reverse(minors.begin(), minors.end());
  return minors;
}

/// The inverse by leading and trailing minors, nguyen-turski (4.6), (C.4) and (C.6). Entries are not finite
/// where minors overflow or the matrix is singular.
template <class T>
Matrix<T> inverse_by_minors(const Tridiagonal<T>& s) {
  const std::size_t rows = s.rows();
  const std::vector<T> leading = leading_minors(s), trailing = trailing_minors(s);
  Matrix<T> inverse(rows, rows);
  for (std::size_t i = 0; i < rows; ++i) {
    T product = leading[i] / leading[rows];
    for (std::size_t j = i; j < rows; ++j) {
      inverse(i, j) = inverse(j, i) = product * trailing[j + 1];
      if (j + 1 < rows) product = -(product * s.couplings[j]);
    }
  }
  return inverse;
}

/// A one-pair matrix: entries left[i] right[j] for i <= j, and symmetric.
template <class T>
struct OnePair {
  std::vector<T> left, right;

  [[nodiscard]] Matrix<T> dense() const {
    Matrix<T> m(left.size(), left.size());
    for (std::size_t i = 0; i < left.size(); ++i)
      for (std::size_t j = i; j < left.size(); ++j) m(i, j) = m(j, i) = left[i] * right[j];
    return m;
  }
};

/// The inverse of a tridiagonal matrix as a one-pair matrix, nguyen-turski (C.7) - (C.9). No coupling may be
/// zero (the inverse is then block diagonal, and no one-pair matrix).
template <class T>
OnePair<T> one_pair_inverse(const Tridiagonal<T>& s) {
  const std::size_t rows = s.rows();
  const std::vector<T> leading = leading_minors(s), trailing = trailing_minors(s);
  OnePair<T> pair{std::vector<T>(rows), std::vector<T>(rows)};
  T product(1);  // of the couplings from k on
  for (std::size_t k = rows; k-- > 0;) {
    if (k + 1 < rows) product = product * s.couplings[k];
    const T sign(k % 2 == 0 ? -1 : 1);
    pair.left[k] = sign * leading[k] * product / leading[rows];
    pair.right[k] = sign * trailing[k + 1] / product;
  }
  return pair;
}

/// The converse: a regular one-pair matrix has a tridiagonal inverse. With e_k = left[k + 1] right[k] -
/// left[k] right[k + 1] its couplings are -1 / e_k, and its diagonal entries (left[k + 1] right[k - 1] -
/// left[k - 1] right[k + 1]) / (e_{k-1} e_k), where beyond the ends left[-1] = right[K] = 0 and left[K] =
/// right[-1] = 1. The matrix is regular where no e_k, left[0] or right[K - 1] vanishes.
template <class T>
Tridiagonal<T> tridiagonal_inverse(const OnePair<T>& pair) {
  const std::size_t rows = pair.left.size();
  // Places 1 .. K are the rows, 0 and K + 1 beyond the ends.
  std::vector<T> left{T(0)}, right{T(1)};
  left.insert(left.end(), pair.left.begin(), pair.left.end());
  right.insert(right.end(), pair.right.begin(), pair.right.end());
  left.push_back(T(1));
  right.push_back(T(0));
  std::vector<T> e;
  for (std::size_t k = 0; k <= rows; ++k) e.push_back(left[k + 1] * right[k] - left[k] * right[k + 1]);
  Tridiagonal<T> s;
  for (std::size_t k = 1; k <= rows; ++k) {
    s.diagonal.push_back((left[k + 1] * right[k - 1] - left[k - 1] * right[k + 1]) / (e[k - 1] * e[k]));
    if (k < rows) s.couplings.push_back(T(-1) / e[k]);
  }
  return s;
}

/// The upper triangular U with U^T S U = 1 of a positive definite tridiagonal S: U_ij = z_i y_i ... y_{j-1}
/// x_j for i <= j (nguyen-turski (C.12) - (C.15), with x_K = 1, which the reference leaves open). As U U^T
/// is the inverse of S, nothing in U overflows before the entries of the inverse do.
template <class T>
struct InverseFactor {
  std::vector<T> x, y, z;  // K, K - 1, K numbers
  std::vector<T> beta;     // the couplings that are left when each row is normalised, K - 1

  [[nodiscard]] Matrix<T> dense() const {
    Matrix<T> u(x.size(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      T product = z[i];
      for (std::size_t j = i; j < x.size(); ++j) {
        u(i, j) = product * x[j];
        if (j + 1 < x.size()) product = product * y[j];
      }
    }
    return u;
  }
  /// The inverse, as nguyen-turski (C.16) with the sum up to K: (U U^T)_ij = z_i z_j sum over k >= i, j of
  /// x_k^2 (y_i ... y_{k-1}) (y_j ... y_{k-1}).
  [[nodiscard]] Matrix<T> inverse() const {
    const std::size_t rows = x.size();
    Matrix<T> m(rows, rows);
    for (std::size_t j = rows; j-- > 0;) {
      T sum(0), product(1);
      for (std::size_t k = j; k < rows; ++k) {
        sum = sum + x[k] * x[k] * product * product;
        if (k + 1 < rows) product = product * y[k];
      }
      T row = sum;
      for (std::size_t i = j + 1; i-- > 0;) {
        if (i < j) row = row * y[i];
        m(i, j) = m(j, i) = z[i] * z[j] * row;
      }
    }
    return m;
  }
};

/// Computes U. Entries are not finite where S is not positive definite.
template <class T>
InverseFactor<T> inverse_factor(const Tridiagonal<T>& s) {
  const std::size_t rows = s.rows();
  InverseFactor<T> u;
  u.z.push_back(T(1));
  if (rows == 1) {
    u.x.push_back(T(1) / sqrt(s.diagonal[0]));
    return u;
  }
  T a = s.diagonal[0];
  for (std::size_t k = 0; k + 1 < rows; ++k) {
    const T beta = k == 0 ? s.couplings[0] : s.couplings[k] * u.z[k];
    const T determinant = a * s.diagonal[k + 1] - beta * beta;
    u.beta.push_back(beta);
    u.x.push_back(T(1) / sqrt(a));
    u.z.push_back(sqrt(a / determinant));
    u.y.push_back(-(beta / sqrt(a * determinant)));
    a = T(1);
  }
  u.x.push_back(T(1));
  return u;
}

/// The beta of InverseFactor without its other numbers, nguyen-turski (C.17); S has two rows or more.
template <class T>
std::vector<T> normalised_couplings(const Tridiagonal<T>& s) {
  std::vector<T> beta{s.couplings[0]};
  for (std::size_t k = 1; k + 1 < s.rows(); ++k) {
    const T left = k == 1 ? s.diagonal[1] - beta[0] * beta[0] / s.diagonal[0]
                          : s.diagonal[k] - beta[k - 1] * beta[k - 1];
    beta.push_back(s.couplings[k] / sqrt(left));
  }
  return beta;
}

}  // namespace pfaff
