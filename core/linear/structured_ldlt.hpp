// StructuredLDLT: L D L^T of a symmetric matrix on a pattern, without row exchanges.
//
// Made for S = B M^-1 B^T, which is positive definite where the constraints are independent: then no pivot is
// small against its row and L D L^T without exchanges is as accurate as any factorisation (higham2002,
// section 10.1). Nothing is allocated after construction, and solve() may be called from several threads.
#pragma once

#include <pfaff/core/linear/structured_elimination.hpp>

namespace pfaff {

/// L D L^T over any scalar: numbers, duals, formulas that are being recorded, packs, exact rationals.
template <class T>
class StructuredLDLT : public detail::StructuredElimination<T, true> {
 public:
  using detail::StructuredElimination<T, true>::StructuredElimination;

  /// The couplings to fill, in the order of the pattern's. The entries are kept by factor().
  T* couplings() { return this->lower_.data(); }
  [[nodiscard]] const T* couplings() const { return this->lower_.data(); }

  /// Factors a positive semidefinite matrix: pivots below the round-off of their own diagonal entry are
  /// dropped and their unknowns set to 0, so that solve() gives a solution for right-hand sides in the range.
  /// `singular` where a pivot is not a number (never for formulas that are being recorded).
  Status factor_semidefinite() {
    detail::SemidefinitePivots<T> pivots;
    this->eliminate(pivots);
    this->dropped_ = pivots.dropped();
    return pivots.usable() ? Status::converged : Status::singular;
  }
  /// How many pivots the last factorisation dropped: rows - rank. 0 for formulas that are being recorded.
  [[nodiscard]] std::size_t dropped() const { return this->dropped_; }
};

}  // namespace pfaff
