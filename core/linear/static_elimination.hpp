// Elimination of every structure other than a path or a ring. For a tree or a sparse matrix the pattern's
// plan lists all entries and updates beforehand; for a dense matrix their indices are computed.
#pragma once

#include <array>
#include <cstddef>

#include <pfaff/core/linear/path_elimination.hpp>

namespace pfaff::detail {

/// A diagonal matrix.
template <class T>
class DiagonalElimination {
 public:
  DiagonalElimination(const SymmetricPattern& pattern, const EliminationView<T>& view)
      : view_(view), rows_(pattern.rows()) {}

  template <class Pivots>
  void factor(Pivots& pivots) const {
    for (std::size_t i = 0; i < rows_; ++i)
      view_.reciprocal[i] = pivots.reciprocal(view_.diagonal[i], view_.diagonal[i]);
  }
  template <class Pivots, class B, std::size_t Count>
  void factor_and_solve(Pivots& pivots, const RightHandSides<B, Count>& sides) const {
    factor(pivots);
    solve(sides);
  }
  template <class B, std::size_t Count>
  void solve(const RightHandSides<B, Count>& sides) const {
    const auto& [right, x] = sides;
    for (std::size_t c = 0; c < Count; ++c)
      for (std::size_t i = 0; i < rows_; ++i) x[c][i] = view_.reciprocal[i] * right[c][i];
  }

  template <class Visit>
  void for_each_entry(Visit&& /*visit*/) const {}

 private:
  EliminationView<T> view_;
  std::size_t rows_;
};

/// L D U in the order of the pattern's plan, for trees and sparse matrices.
template <class T, bool Symmetric>
class StaticElimination {
 public:
  StaticElimination(const SymmetricPattern& pattern, const EliminationView<T>& view)
      : plan_(pattern.plan()), view_(view), rows_(pattern.rows()) {}

  template <class Pivots>
  void factor(Pivots& pivots) const {
    T* l = view_.below;
    T* u = view_.above;
    T* pivot = view_.reciprocal;
    for (std::size_t k = 0; k < rows_; ++k) {
      pivot[k] = view_.diagonal[k];
      if constexpr (Pivots::follow_errors) view_.error[k] = view_.diagonal[k];
      const std::size_t i = plan_.order[k];
      for (std::size_t p = plan_.start[k]; p < plan_.start[k + 1]; ++p) {
        const std::size_t c = plan_.coupling[p];
        if constexpr (Symmetric) {
          l[p] = view_.lower[c];
        } else {
          const bool as_given = plan_.row[p] > i;
          l[p] = as_given ? view_.lower[c] : view_.upper[c];
          u[p] = as_given ? view_.upper[c] : view_.lower[c];
        }
      }
    }
    const EliminationPlan::Index* target = plan_.target.data();
    for (std::size_t k = 0; k < rows_; ++k) {
      const std::size_t i = plan_.order[k], end = plan_.start[k + 1];
      const T r = pivots.reciprocal(pivot[i], Pivots::follow_errors ? view_.error[i] : pivot[i]);
      pivot[i] = r;
      for (std::size_t b = plan_.start[k]; b < end; ++b) {
        const T lower = l[b], upper = u[b];
        const T scaled = lower * r;
        T& diagonal = pivot[plan_.row[b]];
        diagonal = diagonal - upper * scaled;
        if constexpr (Pivots::follow_errors) {
          T& error = view_.error[plan_.row[b]];
          error = error + (scaled * scaled) * view_.error[i];
        }
        if constexpr (Symmetric) {
          for (std::size_t a = b + 1; a < end; ++a, ++target) l[*target] = l[*target] - l[a] * scaled;
        } else {
          const T scaled_upper = upper * r;
          for (std::size_t a = b + 1; a < end; ++a, ++target) {
            l[*target] = l[*target] - l[a] * scaled_upper;
            u[*target] = u[*target] - u[a] * scaled;
          }
          u[b] = scaled_upper;
        }
        l[b] = scaled;
      }
    }
  }

  template <class Pivots, class B, std::size_t Count>
  void factor_and_solve(Pivots& pivots, const RightHandSides<B, Count>& sides) const {
    factor(pivots);
    solve(sides);
  }
  template <class B, std::size_t Count>
  void solve(const RightHandSides<B, Count>& sides) const {
    const auto& [right, x] = sides;
    for (std::size_t c = 0; c < Count; ++c)
      if (right[c] != x[c])
        for (std::size_t i = 0; i < rows_; ++i) x[c][i] = right[c][i];
    std::array<B, Count> y;
    for (std::size_t k = 0; k < rows_; ++k) {
      const std::size_t i = plan_.order[k];
      for (std::size_t c = 0; c < Count; ++c) y[c] = x[c][i];
      for (std::size_t p = plan_.start[k]; p < plan_.start[k + 1]; ++p)
        for (std::size_t c = 0; c < Count; ++c) {
          B& later = x[c][plan_.row[p]];
          later = later - view_.below[p] * y[c];
        }
      for (std::size_t c = 0; c < Count; ++c) x[c][i] = view_.reciprocal[i] * y[c];
    }
    for (std::size_t k = rows_; k-- > 0;) {
      const std::size_t i = plan_.order[k];
      for (std::size_t c = 0; c < Count; ++c) y[c] = x[c][i];
      for (std::size_t p = plan_.start[k]; p < plan_.start[k + 1]; ++p)
        for (std::size_t c = 0; c < Count; ++c) y[c] = y[c] - view_.above[p] * x[c][plan_.row[p]];
      for (std::size_t c = 0; c < Count; ++c) x[c][i] = y[c];
    }
  }

  template <class Visit>
  void for_each_entry(Visit&& visit) const {
    for (std::size_t k = 0; k < rows_; ++k)
      for (std::size_t p = plan_.start[k]; p < plan_.start[k + 1]; ++p)
        visit(std::size_t(plan_.row[p]), std::size_t(plan_.order[k]), view_.below[p], view_.above[p]);
  }

 private:
  const EliminationPlan& plan_;
  EliminationView<T> view_;
  std::size_t rows_;
};

/// L D U of a dense matrix in its own order. The columns of L, and the rows of U, are stored one after the
/// other.
template <class T, bool Symmetric>
class DenseElimination {
 public:
  DenseElimination(const SymmetricPattern& pattern, const EliminationView<T>& view)
      : pattern_(pattern), view_(view), rows_(pattern.rows()) {}

  template <class Pivots>
  void factor(Pivots& pivots) const {
    T* l = view_.below;
    T* u = view_.above;
    T* pivot = view_.reciprocal;
    for (std::size_t i = 0; i < rows_; ++i) {
      pivot[i] = view_.diagonal[i];
      if constexpr (Pivots::follow_errors) view_.error[i] = view_.diagonal[i];
    }
    for (std::size_t p = 0; p < rows_ * (rows_ - 1) / 2; ++p) l[p] = u[p] = T(0);
    const auto& couplings = pattern_.couplings();
    for (std::size_t c = 0; c < couplings.size(); ++c) {
      const std::size_t p = start(couplings[c].first) + (couplings[c].second - couplings[c].first - 1);
      l[p] = view_.lower[c];
      if constexpr (!Symmetric) u[p] = view_.upper[c];
    }
    for (std::size_t k = 0; k < rows_; ++k) {
      const T r = pivots.reciprocal(pivot[k], Pivots::follow_errors ? view_.error[k] : pivot[k]);
      pivot[k] = r;
      const std::size_t later = rows_ - k - 1;
      T* lower = l + start(k);
      T* upper = u + start(k);
      for (std::size_t b = 0; b < later; ++b) {
        const T scaled = lower[b] * r;
        pivot[k + 1 + b] = pivot[k + 1 + b] - upper[b] * scaled;
        if constexpr (Pivots::follow_errors)
          view_.error[k + 1 + b] = view_.error[k + 1 + b] + (scaled * scaled) * view_.error[k];
        T* lower_target = l + start(k + 1 + b);
        if constexpr (Symmetric) {
          for (std::size_t a = b + 1; a < later; ++a)
            lower_target[a - b - 1] = lower_target[a - b - 1] - lower[a] * scaled;
        } else {
          const T scaled_upper = upper[b] * r;
          T* upper_target = u + start(k + 1 + b);
          for (std::size_t a = b + 1; a < later; ++a) {
            lower_target[a - b - 1] = lower_target[a - b - 1] - lower[a] * scaled_upper;
            upper_target[a - b - 1] = upper_target[a - b - 1] - upper[a] * scaled;
          }
          upper[b] = scaled_upper;
        }
        lower[b] = scaled;
      }
    }
  }

  template <class Pivots, class B, std::size_t Count>
  void factor_and_solve(Pivots& pivots, const RightHandSides<B, Count>& sides) const {
    factor(pivots);
    solve(sides);
  }
  template <class B, std::size_t Count>
  void solve(const RightHandSides<B, Count>& sides) const {
    const auto& [right, x] = sides;
    for (std::size_t c = 0; c < Count; ++c) {
      B* y = x[c];
      if (right[c] != y)
        for (std::size_t i = 0; i < rows_; ++i) y[i] = right[c][i];
      for (std::size_t k = 0; k < rows_; ++k) {
        const B pivot = y[k];
        const T* lower = view_.below + start(k);
        for (std::size_t i = k + 1; i < rows_; ++i) y[i] = y[i] - lower[i - k - 1] * pivot;
        y[k] = view_.reciprocal[k] * pivot;
      }
      for (std::size_t k = rows_; k-- > 0;) {
        const T* upper = view_.above + start(k);
        B sum = y[k];
        for (std::size_t i = k + 1; i < rows_; ++i) sum = sum - upper[i - k - 1] * y[i];
        y[k] = sum;
      }
    }
  }

  template <class Visit>
  void for_each_entry(Visit&& visit) const {
    for (std::size_t k = 0; k < rows_; ++k)
      for (std::size_t i = k + 1; i < rows_; ++i)
        visit(i, k, view_.below[start(k) + i - k - 1], view_.above[start(k) + i - k - 1]);
  }

 private:
  [[nodiscard]] std::size_t start(std::size_t k) const { return k * (2 * rows_ - k - 1) / 2; }

  const SymmetricPattern& pattern_;
  EliminationView<T> view_;
  std::size_t rows_;
};

}  // namespace pfaff::detail
