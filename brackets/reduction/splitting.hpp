// Reduction of tensors on a linear space E = F + V (nguyen-turski section 2): K_F(alpha, ...) = K(p* alpha,
// ...) with p the projection onto F along V.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// E = F + V, bases in columns. InputError where the two do not make up E.
template <class T>
class Splitting {
 public:
  Splitting(const Matrix<T>& f, const Matrix<T>& v)
      : projection_(f.rows(), f.rows()), annihilator_(v.columns(), f.rows()) {
    const std::size_t n = f.rows(), r = f.columns();
    if (v.rows() != n || r + v.columns() != n)
      throw InputError("splitting: dimensions " + std::to_string(r) + " and " + std::to_string(v.columns()) +
                       " do not make up " + std::to_string(n));
    LU<T> lu(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) lu(i, j) = j < r ? f(i, j) : v(i, j - r);
    if (!lu.factor()) throw InputError("splitting: the two subspaces have a vector in common");
    std::vector<T> unit(n), coordinates(n);
    for (std::size_t j = 0; j < n; ++j) {
      unit[j] = T(1);
      lu.solve(unit.data(), coordinates.data());
      unit[j] = T(0);
      for (std::size_t k = 0; k < r; ++k)
        for (std::size_t i = 0; i < n; ++i) projection_(i, j) = projection_(i, j) + f(i, k) * coordinates[k];
      for (std::size_t k = r; k < n; ++k) annihilator_(k - r, j) = coordinates[k];
    }
  }

  /// p: E -> F along V, n x n.
  [[nodiscard]] const Matrix<T>& projection() const { return projection_; }
  /// A basis of F^0 = V* in rows.
  [[nodiscard]] const Matrix<T>& annihilator() const { return annihilator_; }

  /// K_F of a vector (k = 1) and of a contravariant 2-tensor (k = 2): (2.1), as tensors on E.
  [[nodiscard]] std::vector<T> reduced(const std::vector<T>& k) const { return projection_ * k; }
  [[nodiscard]] Matrix<T> reduced(const Matrix<T>& k) const {
    return projection_ * k * projection_.transposed();
  }

  /// p(P F^0), a column for each covector of the annihilator: zero where p is a Dirac projection for P, which
  /// makes the reduction of a constant P split, P = P_F + P_V.
  [[nodiscard]] Matrix<T> dirac_projection_defect(const Matrix<T>& p) const {
    return projection_ * p * annihilator_.transposed();
  }

 private:
  Matrix<T> projection_, annihilator_;
};

}  // namespace pfaff
