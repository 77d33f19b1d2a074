// Elimination of a tridiagonal matrix, with or without a border, from both ends towards the middle.
//
// A division waits for the one before it. Two eliminations that start at the two ends and meet in the middle
// are independent of each other and hide half of the waiting. Every row is divided by its pivot once; later
// passes multiply.
#pragma once

#include <array>
#include <cstddef>

#include <pfaff/core/linear/symmetric_pattern.hpp>

namespace pfaff::detail {

/// A matrix and its factors L D U, unit triangular L and U. Entry c of `lower` is a_ji, of `upper` a_ij for
/// coupling c = (i, j), i < j, with a zero behind the last. `below` and `above` hold the entries of L and U.
/// The two pairs are one where the matrix is symmetric.
template <class T>
struct EliminationView {
  const T *diagonal, *lower, *upper;
  T *reciprocal, *below, *above;  // reciprocal[i]: 1 / pivot of row i
};

/// The path of a tridiagonal matrix, or of a ring whose last row is the border.
template <class T, bool Symmetric, bool Natural, bool Border>
class PathElimination {
 public:
  PathElimination(const SymmetricPattern& pattern, const EliminationView<T>& view)
      : plan_(pattern.plan()), view_(view), rows_(pattern.rows() - (Border ? 1 : 0)), middle_(rows_ / 2) {}

  template <class Pivots>
  void factor(Pivots& pivots) const {
    End left{0, view_.diagonal[row(0)]}, right{rows_ - 1, view_.diagonal[row(rows_ - 1)]};
    if constexpr (Border) {
      enter_border(left, rows_);
      enter_border(right, rows_ - 1);
    }
    while (right.at > middle_ + 1) {
      eliminate(left, left.at + 1, pivots);
      eliminate(right, right.at - 1, pivots);
    }
    while (left.at < middle_) eliminate(left, left.at + 1, pivots);
    if (right.at > middle_) {
      eliminate(right, middle_, pivots);
      left.pivot = left.pivot - right.subtracted;
    }
    const std::size_t m = row(middle_);
    const T r = pivots.reciprocal(left.pivot, view_.diagonal[m], 2);
    view_.reciprocal[m] = r;
    if constexpr (Border) {
      const T lower = left.border_lower + right.border_lower, upper = left.border_upper + right.border_upper;
      view_.below[rows_ + middle_] = lower * r;
      if constexpr (!Symmetric) view_.above[rows_ + middle_] = upper * r;
      const std::size_t v = row(rows_);
      const T pivot = ((view_.diagonal[v] - left.border_sum) - right.border_sum) - (lower * upper) * r;
      view_.reciprocal[v] = pivots.reciprocal(pivot, view_.diagonal[v], rows_);
    }
  }

  /// Count solutions at once; right[k] and x[k] may be the same.
  template <std::size_t Count, class B>
  void solve(const std::array<const B*, Count>& right, const std::array<B*, Count>& x) const {
    const T* l = view_.below;
    const T* u = view_.above;
    const T* r = view_.reciprocal;
    std::array<B, Count> left, other, border;
    const std::size_t last = rows_ - 1;
    for (std::size_t c = 0; c < Count; ++c) {
      if constexpr (Border) border[c] = right[c][row(rows_)];
      left[c] = right[c][row(0)];
      other[c] = right[c][row(last)];
    }
    const auto towards_middle = [&](std::array<B, Count>& y, std::size_t at, std::size_t next,
                                    std::size_t link) {
      for (std::size_t c = 0; c < Count; ++c) {
        x[c][row(at)] = y[c];
        if constexpr (Border) border[c] = border[c] - l[rows_ + at] * y[c];
        y[c] = right[c][row(next)] - l[link] * y[c];
      }
    };
    std::size_t i = 0, j = last;
    for (; j > middle_ + 1; ++i, --j) {
      towards_middle(left, i, i + 1, i);
      towards_middle(other, j, j - 1, j - 1);
    }
    for (; i < middle_; ++i) towards_middle(left, i, i + 1, i);
    for (std::size_t c = 0; c < Count; ++c) {
      if (j > middle_) {
        x[c][row(j)] = other[c];
        if constexpr (Border) border[c] = border[c] - l[rows_ + j] * other[c];
        left[c] = left[c] - l[middle_] * other[c];
      }
      if constexpr (Border) {
        border[c] = (border[c] - l[rows_ + middle_] * left[c]) * r[row(rows_)];
        x[c][row(rows_)] = border[c];
      }
      left[c] = left[c] * r[row(middle_)];
      if constexpr (Border) left[c] = left[c] - u[rows_ + middle_] * border[c];
      x[c][row(middle_)] = left[c];
    }
    other = left;
    const auto outwards = [&](std::array<B, Count>& y, std::size_t at, std::size_t link) {
      for (std::size_t c = 0; c < Count; ++c) {
        B scaled = x[c][row(at)] * r[row(at)];
        if constexpr (Border) scaled = scaled - u[rows_ + at] * border[c];
        y[c] = scaled - u[link] * y[c];
        x[c][row(at)] = y[c];
      }
    };
    i = middle_;
    j = middle_;
    for (; j < last && i > 0; --i, ++j) {
      outwards(left, i - 1, i - 1);
      outwards(other, j + 1, j);
    }
    for (; i > 0; --i) outwards(left, i - 1, i - 1);
  }

 private:
  /// One of the two fronts: where it is, the pivot there, what its last step subtracted, and the border's
  /// entries in this row and contribution so far.
  struct End {
    std::size_t at;
    T pivot;
    T subtracted{};
    T border_lower{}, border_upper{}, border_sum{};
  };

  [[nodiscard]] std::size_t row(std::size_t k) const {
    if constexpr (Natural)
      return k;
    else
      return plan_.order[k];
  }
  [[nodiscard]] std::size_t link(std::size_t k) const {
    if constexpr (Natural)
      return k;
    else
      return plan_.link[k];
  }
  /// The matrix entry in the row at place `i` and the column at place `j` of the path, of coupling c.
  const T& entry(std::size_t i, std::size_t j, std::size_t c) const {
    if constexpr (Symmetric)
      return view_.lower[c];
    else
      return row(i) > row(j) ? view_.lower[c] : view_.upper[c];
  }
  void enter_border(End& end, std::size_t link_index) const {
    end.border_lower = entry(rows_, end.at, link(link_index));
    end.border_upper = entry(end.at, rows_, link(link_index));
    end.border_sum = T(0);
  }

  template <class Pivots>
  void eliminate(End& end, std::size_t next, Pivots& pivots) const {
    const std::size_t between = end.at < next ? end.at : next, c = link(between), here = row(end.at);
    const T r = pivots.reciprocal(end.pivot, view_.diagonal[here], 1);
    view_.reciprocal[here] = r;
    const T lower = entry(next, end.at, c), upper = entry(end.at, next, c);
    const T l = lower * r;
    view_.below[between] = l;
    T u = l;
    if constexpr (!Symmetric) {
      u = upper * r;
      view_.above[between] = u;
    }
    // The product of the couplings does not wait for the division.
    end.subtracted = (lower * upper) * r;
    if constexpr (Border) {
      view_.below[rows_ + end.at] = end.border_lower * r;
      if constexpr (!Symmetric) view_.above[rows_ + end.at] = end.border_upper * r;
      end.border_sum = end.border_sum + (end.border_lower * end.border_upper) * r;
      end.border_lower = -(end.border_lower * u);
      end.border_upper = -(end.border_upper * l);
    }
    end.pivot = view_.diagonal[row(next)] - end.subtracted;
    end.at = next;
  }

  const EliminationPlan& plan_;
  EliminationView<T> view_;
  std::size_t rows_, middle_;
};

}  // namespace pfaff::detail
