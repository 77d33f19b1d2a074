// The Poisson brackets W_ij = {phi_i, phi_j} of a system's constraints at one state, with the values,
// gradients and tensor they are made of, and the classes (first or second class, redundant) that follow from
// them.
#pragma once

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// Everything about K constraints on n coordinates at one state and time. Where the constraints are
/// holonomic, every phi is followed by its hidden constraint phi~ = d phi / dt, as in
/// Model::constraint_names, and K counts both.
template <class T>
struct ConstraintBrackets {
  std::vector<T> values;      // K
  std::vector<T> rates;       // K: the partial derivative of phi by t, zero unless phi depends on time
  Matrix<T> gradients;        // K x n
  Matrix<T> tensor;           // n x n: Pi
  Matrix<T> brackets;         // K x K: W
  bool finite = true;         // true where every number above is finite
  Classification<T> classes;  // of the constraints; left empty where `finite` is false
};

/// Evaluates the constraints of `model` at (t, z). T is double or Quad.
template <class T>
ConstraintBrackets<T> constraint_brackets(const Model& model, const T& t, const std::vector<T>& z);

/// The tensor of Dirac's bracket, n x n: Pi - Pi dphi^T W^-1 dphi Pi. Not finite where W is singular.
template <class T>
Matrix<T> dirac_tensor(const ConstraintBrackets<T>& of) {
  const Matrix<T> sharps = of.tensor * of.gradients.transposed();
  return of.tensor - sharps * (inverse(of.brackets) * (of.gradients * of.tensor));
}

}  // namespace pfaff
