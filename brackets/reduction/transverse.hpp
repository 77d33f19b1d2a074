// The transverse Poisson structure at a point (pitanga-rodrigues 3.2): Pi_M = Pi_W - Pi_S on the submanifold
// of constraints x^a = 0, second class, with the convention X^a(f) = {x^a, f}, lambda^{ab} = {x^a, x^b}.
#pragma once

#include <cstddef>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// The tensors of a splitting of TW by the constraints with gradients `dx` (K x n) and a bracket Pi_W = P
/// (n x n); (17) is nguyen-turski (3.5). For skew P; any scalar with the four operations.
template <class T>
class TransverseStructure {
 public:
  /// InputError where lambda is singular.
  TransverseStructure(const Matrix<T>& p, const Matrix<T>& dx)
      : whole_(p), dx_(dx), fields_(dx * p), lambda_(fields_ * dx.transposed()), inverse_(regular(lambda_)) {}

  /// X^a in rows: X^a_i = {x^a, z_i}.
  [[nodiscard]] const Matrix<T>& fields() const { return fields_; }
  /// lambda^{ab} and its inverse lambda_{ab}, (14).
  [[nodiscard]] const Matrix<T>& lambda() const { return lambda_; }
  [[nodiscard]] const Matrix<T>& lambda_inverse() const { return inverse_; }

  /// p*_TS = lambda_ab dx^a (x) X^b on covectors; on vectors p_TS is its transpose.
  [[nodiscard]] Matrix<T> leaf_projection() const { return dx_.transposed() * inverse_ * fields_; }
  /// Pi_S = -1/2 lambda_ab X^a ^ X^b, which is {f, x^a} lambda_ab {x^b, g}.
  [[nodiscard]] Matrix<T> leaf() const { return -(fields_.transposed() * inverse_ * fields_); }
  /// Pi_M = Pi_W - Pi_S, (17).
  [[nodiscard]] Matrix<T> transverse() const { return whole_ - leaf(); }
  /// (13): p_TM . sharp . p*_TM with p*_TM = I - p*_TS; equals transverse().
  [[nodiscard]] Matrix<T> composed() const {
    const Matrix<T> onto = Matrix<T>::identity(whole_.rows()) - leaf_projection();
    return onto.transposed() * whole_ * onto;
  }

 private:
  static Matrix<T> regular(const Matrix<T>& lambda) {
    LU<T> lu(lambda.rows());
    for (std::size_t i = 0; i < lambda.rows(); ++i)
      for (std::size_t j = 0; j < lambda.rows(); ++j) lu(i, j) = lambda(i, j);
    if (lambda.rows() != lambda.columns() || !lu.factor())
      throw InputError("transverse structure: the brackets of the constraints are singular at this point");
    return inverse(lambda);
  }
  Matrix<T> whole_, dx_, fields_, lambda_, inverse_;
};

}  // namespace pfaff
