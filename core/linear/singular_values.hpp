// Singular values and right singular vectors of small square matrices, by one-sided Jacobi rotations.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// values[k] is the length of A v_k for the orthonormal columns v_k of `vectors`; in no order.
template <class T>
struct SingularValues {
  std::vector<T> values;
  Matrix<T> vectors;
};

/// Rotates pairs of columns of A until all are orthogonal to round-off. Small values are found to the
/// accuracy of the entries, as A^T A is never formed. Values of a matrix that is not finite are not finite.
template <class T>
SingularValues<T> singular_values(Matrix<T> a) {
  const std::size_t n = a.rows();
  Matrix<T> v = Matrix<T>::identity(n);
  const auto rotate = [n](Matrix<T>& m, std::size_t p, std::size_t q, const T& c, const T& s) {
    for (std::size_t i = 0; i < n; ++i) {
      const T left = m(i, p), right = m(i, q);
      m(i, p) = c * left - s * right;
      m(i, q) = s * left + c * right;
    }
  };
  // Convergence is quadratic, so that ten sweeps are already many. The limit is for two columns that are
  // orthogonal to within round-off and would be rotated for ever.
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < 40; ++sweep) {
    rotated = false;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        T left(0), right(0), product(0);
        for (std::size_t i = 0; i < n; ++i) {
          left = left + a(i, p) * a(i, p);
          right = right + a(i, q) * a(i, q);
          product = product + a(i, p) * a(i, q);
        }
        if (!(abs(product) > std::numeric_limits<T>::epsilon() * sqrt(left) * sqrt(right))) continue;
        rotated = true;
        const T zeta = (right - left) / (T(2) * product), size = abs(zeta) + sqrt(T(1) + zeta * zeta);
        const T tangent = (zeta < T(0) ? T(-1) : T(1)) / size, c = T(1) / sqrt(T(1) + tangent * tangent);
        rotate(a, p, q, c, c * tangent);
        rotate(v, p, q, c, c * tangent);
      }
  }
  SingularValues<T> result{std::vector<T>(n), std::move(v)};
  for (std::size_t k = 0; k < n; ++k) {
    T sum(0);
    for (std::size_t i = 0; i < n; ++i) sum = sum + a(i, k) * a(i, k);
    result.values[k] = sqrt(sum);
  }
  return result;
}

}  // namespace pfaff
