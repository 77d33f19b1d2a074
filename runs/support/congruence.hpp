// Congruences M^T K1 M = K0 of matrices, by which structures are kept, and how far matrices are from one.
#pragma once

#include <utility>
#include <vector>

#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// All square, of one size.
template <class T>
struct Congruence {
  Matrix<T> m, k1, k0;
};

/// M^T K1 M - K0, and for each entry the sum of the magnitudes of the terms of M^T K1 M.
template <class T>
struct CongruenceDifference {
  explicit CongruenceDifference(const Congruence<T>& of);
  CongruenceDifference(Matrix<T> entries_of, Matrix<T> sizes_of)
      : entries(std::move(entries_of)), sizes(std::move(sizes_of)) {}
  Matrix<T> entries, sizes;
};

/// The relative residual max |M^T K1 M - K0| / max |M|^T |K1| |M|.
template <class T>
T congruence_residual(const CongruenceDifference<T>& difference);
/// The same of n x n matrices, row-major.
template <class T>
T congruence_residual(const std::vector<T>& m, const std::vector<T>& k1, const std::vector<T>& k0);

/// Units of the coordinates, as powers of two, in which the largest entries in the rows of A^T |K1| A are
/// alike, A being |M| + 1: what small coordinates lose does not hide behind large ones there. The unit matrix
/// is for directions that M leads to nothing, whose entries are round-off. Empty where these units differ by
/// less than 64, so that ordinary systems keep their own coordinates.
template <class T>
std::vector<T> equilibrating_units(const Congruence<T>& of);

/// A difference in coordinates divided by `units`.
template <class T>
CongruenceDifference<T> in_units(const CongruenceDifference<T>& difference, const std::vector<T>& units);

/// The matrix in coordinates divided by `units`: a_ij u_i^row u_j^column. A Jacobian has the exponents -1 and
/// 1, a two-form 1 and 1, a Poisson tensor -1 and -1. Without units the matrix is returned as it is.
template <class T>
std::vector<T> in_units(std::vector<T> a, const std::vector<T>& units, int row, int column) {
  const std::size_t n = units.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      T& x = a[i * n + j];
      x = row > 0 ? T(x * units[i]) : T(x / units[i]);
      x = column > 0 ? T(x * units[j]) : T(x / units[j]);
    }
  return a;
}

}  // namespace pfaff
