// The brackets of a system's constraints at a state: W_ij = {phi_i, phi_j} and what is made of it.
#pragma once

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// K constraints on n coordinates at one state and time. Of holonomic ones every phi is followed by its
/// hidden phi~, as in Model::constraint_names.
template <class T>
struct ConstraintBrackets {
  std::vector<T> values;      // K
  std::vector<T> rates;       // K: d phi / dt at rest, where constraints depend on time
  Matrix<T> gradients;        // K x n
  Matrix<T> tensor;           // n x n: Pi
  Matrix<T> brackets;         // K x K: W
  bool finite = true;         // every number above is
  Classification<T> classes;  // of the constraints; empty where not finite
};

/// T is double or Quad.
template <class T>
ConstraintBrackets<T> constraint_brackets(const Model& model, const T& t, const std::vector<T>& z);

}  // namespace pfaff
