// StructuredLU: L D U of a matrix whose pattern is symmetric and whose values need not be, without row
// exchanges. Made for B(q_0) M^-1 B(q_1)^T of a Newton iteration and for the skew matrix of brackets of
// constraints.
#pragma once

#include <pfaff/core/linear/structured_elimination.hpp>

namespace pfaff {

/// L D U over any scalar. Without exchanges a pivot may vanish although the matrix is regular (every skew
/// matrix has a zero diagonal); factor() then returns `singular`.
template <class T>
class StructuredLU : public detail::StructuredElimination<T, false> {
 public:
  using detail::StructuredElimination<T, false>::StructuredElimination;

  /// The entries a_ji (`lower`) and a_ij (`upper`) of the couplings (i, j), i < j, to fill in the order of
  /// the pattern's. They are kept by factor().
  T* lower() { return this->lower_.data(); }
  T* upper() { return this->upper_.data(); }
};

}  // namespace pfaff
