// What StructuredLDLT and StructuredLU have in common: storage, and the choice of the elimination.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/linear/path_elimination.hpp>
#include <pfaff/core/linear/pivot.hpp>
#include <pfaff/core/linear/static_elimination.hpp>
#include <pfaff/core/linear/symmetric_pattern.hpp>
#include <pfaff/core/solve/status.hpp>

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
        above_(Symmetric ? 0 : below_.size(), T(0)) {}

  [[nodiscard]] const SymmetricPattern& pattern() const { return *pattern_; }

  /// The diagonal to fill, in the order of rows. The entries are kept by factor().
  T* diagonal() { return diagonal_.data(); }
  [[nodiscard]] const T* diagonal() const { return diagonal_.data(); }

  /// Factors the entries. `singular` where a pivot is zero or not finite; formulas that are being recorded
  /// have no numbers to look at and always go on.
  Status factor() {
    RegularPivots<T> pivots;
    dropped_ = 0;
    eliminate(pivots);
    return pivots.usable() ? Status::converged : Status::singular;
  }

  /// solution = A^-1 right_hand_side; the two may be the same. B is T or a scalar richer than T, such as a
  /// dual over it.
  template <class B>
  void solve(const B* right_hand_side, B* solution) const {
    substitute<1, B>({right_hand_side}, {solution});
  }
  /// Two right-hand sides at once; r1 and x1, r2 and x2 may be the same.
  template <class B>
  void solve(const B* r1, B* x1, const B* r2, B* x2) const {
    substitute<2, B>({r1, r2}, {x1, x2});
  }

 protected:
  template <class Pivots>
  void eliminate(Pivots& pivots) {
    if (pattern_->rows() == 0) return;
    const EliminationView<T> all{
        diagonal_.data(),   lower_.data(), Symmetric ? lower_.data() : upper_.data(),
        reciprocal_.data(), below_.data(), Symmetric ? below_.data() : above_.data()};
    visit(all, [&](const auto& elimination) { elimination.factor(pivots); });
  }

  std::shared_ptr<const SymmetricPattern> pattern_;
  std::vector<T> diagonal_, lower_, upper_;
  std::vector<T> reciprocal_, below_, above_;
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

  template <std::size_t Count, class B>
  void substitute(const std::array<const B*, Count>& right, const std::array<B*, Count>& x) const {
    if (pattern_->rows() == 0) return;
    // Solves only read what the view points to.
    auto* below = const_cast<T*>(below_.data());
    const EliminationView<T> all{nullptr, nullptr,
                                 nullptr, const_cast<T*>(reciprocal_.data()),
                                 below,   Symmetric ? below : const_cast<T*>(above_.data())};
    visit(all, [&](const auto& elimination) { elimination.template solve<Count, B>(right, x); });
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
