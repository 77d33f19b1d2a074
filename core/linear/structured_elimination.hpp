// What StructuredLDLT and StructuredLU have in common: the storage of a matrix on a pattern and of its
// factors, and the choice of the elimination that suits the pattern's structure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/linear/path_elimination.hpp>
#include <pfaff/core/linear/pivot.hpp>
#include <pfaff/core/linear/static_elimination.hpp>
#include <pfaff/core/linear/symmetric_pattern.hpp>

namespace pfaff::detail {

template <class T, bool Symmetric>
class StructuredElimination {
 public:
  explicit StructuredElimination(std::shared_ptr<const SymmetricPattern> pattern)
      : pattern_(std::move(pattern)),
        diagonal_(pattern_->rows(), T(0)),
        lower_(pattern_->couplings().size() + 1, T(0)),
        upper_(Symmetric ? 0 : lower_.size(), T(0)),
        reciprocal_(pattern_->rows(), T(0)),
        below_(factor_size(*pattern_), T(0)),
        above_(Symmetric ? 0 : below_.size(), T(0)),
        error_(Symmetric ? pattern_->rows() : 0, T(0)) {}

  [[nodiscard]] const SymmetricPattern& pattern() const { return *pattern_; }

  /// The diagonal to fill, in the order of rows. The entries are kept by factor().
  T* diagonal() { return diagonal_.data(); }
  [[nodiscard]] const T* diagonal() const { return diagonal_.data(); }

  /// Factors the entries. Returns `singular` where a pivot is zero or not finite. Formulas that are being
  /// recorded have no numbers to inspect, so that their factorisation always goes on and is reported as
  /// converged.
  Status factor() {
    RegularPivots<T> pivots;
    dropped_ = 0;
    eliminate(pivots);
    return pivots.usable() ? Status::converged : Status::singular;
  }

  /// factor() and solve() with the same result to the last bit, in one pass less where the structure is
  /// tridiagonal or cyclic. The solution is of no use unless `converged`.
  Status factor_and_solve(const T* right_hand_side, T* solution) {
    RegularPivots<T> pivots;
    dropped_ = 0;
    if (pattern_->rows() > 0)
      visit(view(), [&](const auto& elimination) {
        elimination.factor_and_solve(pivots, RightHandSides<T, 1>{{right_hand_side}, {solution}});
      });
    return pivots.usable() ? Status::converged : Status::singular;
  }

  /// solution = A^-1 right_hand_side; the two may be the same. B is T or a scalar richer than T, such as a
  /// dual over it.
  template <class B>
  void solve(const B* right_hand_side, B* solution) const {
    substitute(RightHandSides<B, 1>{{right_hand_side}, {solution}});
  }
  /// Two right-hand sides at once; r1 and x1, r2 and x2 may be the same.
  template <class B>
  void solve(const B* r1, B* x1, const B* r2, B* x2) const {
    substitute(RightHandSides<B, 2>{{r1, r2}, {x1, x2}});
  }

  /// The largest diagonal entry of |L| |D| |U| after factor(), relative to the largest entry of the matrix:
  /// how much elimination without exchanges magnifies round-off. It is 1 for a positive definite matrix;
  /// for others it is the larger, the smaller a pivot is. Allocates; for reports and tests.
  [[nodiscard]] Value<T> growth() const {
    std::vector<Value<T>> sums(pattern_->rows(), Value<T>(0));
    const auto pivot = [&](std::size_t i) {
      const Value<T> r = value_of(reciprocal_[i]);
      return r == Value<T>(0) ? r : Value<T>(1) / abs(r);
    };
    Value<T> entry(0), product(0);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] = pivot(i);
      entry = std::max(entry, Value<T>(abs(value_of(diagonal_[i]))));
    }
    for (const std::vector<T>& side : {std::cref(lower_), std::cref(upper_)})
      for (const T& x : side) entry = std::max(entry, Value<T>(abs(value_of(x))));
    if (!sums.empty())
      visit(const_view(), [&](const auto& elimination) {
        elimination.for_each_entry([&](std::size_t later, std::size_t eliminated, const T& l, const T& u) {
          sums[later] = sums[later] + abs(value_of(l)) * pivot(eliminated) * abs(value_of(u));
        });
      });
    for (const Value<T>& x : sums) product = std::max(product, x);
    return product == Value<T>(0) ? product : product / entry;
  }

 protected:
  template <class Pivots>
  void eliminate(Pivots& pivots) {
    if (pattern_->rows() > 0) visit(view(), [&](const auto& elimination) { elimination.factor(pivots); });
  }

  std::shared_ptr<const SymmetricPattern> pattern_;
  std::vector<T> diagonal_, lower_, upper_;
  std::vector<T> reciprocal_, below_, above_, error_;
  std::size_t dropped_ = 0;

 private:
  static std::size_t factor_size(const SymmetricPattern& pattern) {
    const std::size_t rows = pattern.rows();
    switch (pattern.structure()) {
      case MatrixStructure::diagonal:
        return 0;
      case MatrixStructure::tridiagonal:
        return rows;
      case MatrixStructure::cyclic:
        return 2 * rows;
      case MatrixStructure::tree:
      case MatrixStructure::sparse:
        return pattern.plan().row.size();
      case MatrixStructure::dense:
        return rows * (rows - 1) / 2;
    }
    return 0;
  }

  EliminationView<T> view() {
    return {diagonal_.data(),   lower_.data(), Symmetric ? lower_.data() : upper_.data(),
            reciprocal_.data(), below_.data(), Symmetric ? below_.data() : above_.data(),
            error_.data()};
  }

  /// The view for functions that only read the factors.
  EliminationView<T> const_view() const { return const_cast<StructuredElimination*>(this)->view(); }

  template <class B, std::size_t Count>
  void substitute(const RightHandSides<B, Count>& sides) const {
    if (pattern_->rows() == 0) return;
    visit(const_view(), [&](const auto& elimination) { elimination.solve(sides); });
  }

  template <class Use>
  void visit(const EliminationView<T>& all, Use&& use) const {
    switch (pattern_->structure()) {
      case MatrixStructure::diagonal:
        return use(DiagonalElimination<T>(*pattern_, all));
      case MatrixStructure::tridiagonal:
        if (pattern_->plan().natural) return use(PathElimination<T, Symmetric, true, false>(*pattern_, all));
        return use(PathElimination<T, Symmetric, false, false>(*pattern_, all));
      case MatrixStructure::cyclic:
        return use(PathElimination<T, Symmetric, false, true>(*pattern_, all));
      case MatrixStructure::tree:
      case MatrixStructure::sparse:
        return use(StaticElimination<T, Symmetric>(*pattern_, all));
      case MatrixStructure::dense:
        return use(DenseElimination<T, Symmetric>(*pattern_, all));
    }
  }
};

}  // namespace pfaff::detail
