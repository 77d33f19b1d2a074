// Elimination of a tridiagonal matrix, with or without a border, from both ends towards the middle.
//
// A division of a tridiagonal elimination has to wait for the one before it. Two eliminations that start at
// the two ends and meet in the middle are independent of each other, so that each works while the other
// waits. Every row is divided by its pivot once; later passes multiply by the stored reciprocal.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include <pfaff/core/linear/pivot.hpp>
#include <pfaff/core/linear/symmetric_pattern.hpp>

namespace pfaff::detail {

/// A matrix A and its factors L D U, unit triangular L and U. For coupling c = (i, j), i < j, lower[c] is
/// a_ji and upper[c] is a_ij. One more entry, a zero, stands behind the last and serves neighbouring places
/// that are not coupled, as between two paths. `below` and `above` hold the entries of L and U. Where A is
/// symmetric, `lower` and `upper` are the same array, and so are `below` and `above`.
template <class T>
struct EliminationView {
  const T *diagonal, *lower, *upper;
  T *reciprocal, *below, *above;  // reciprocal[i]: 1 / pivot of row i
  T* error;                       // of a row's pivot, in units of round-off
};

/// Right-hand sides and solutions, Count of them at once; the two may be the same.
template <class B, std::size_t Count>
struct RightHandSides {
  std::array<const B*, Count> right;
  std::array<B*, Count> x;
};

/// x with what lies far below 2^-400 of `scale` rounded away. Along a ring the border's entries shrink by a
/// factor from row to row until they underflow, and arithmetic with subnormal numbers is many times slower.
/// Nothing that could be seen in a result is lost.
template <class T>
T without_traces(const T& x, const T& scale) {
  if constexpr (std::is_same_v<T, double> || is_pack<T>) {
    const T trace = scale * T(0x1p-400);
    return (x + trace) - trace;
  } else {
    return x;
  }
}

/// Elimination of a tridiagonal matrix, or, with Border, of a ring: a path and one more row, the border, that
/// is coupled to both ends. Place k is the k-th row along the path, row order[k] of the plan; with Natural
/// the two numbers are equal. The factors' entries between places k and k + 1 are below[k] and above[k].
/// Behind them, from the number of places on, stand those between the border and place k.
template <class T, bool Symmetric, bool Natural, bool Border>
class PathElimination {
 public:
  PathElimination(const SymmetricPattern& pattern, const EliminationView<T>& view)
      : plan_(pattern.plan()), view_(view), rows_(pattern.rows() - (Border ? 1 : 0)), middle_(rows_ / 2) {}

  template <class Pivots>
  void factor(Pivots& pivots) const {
    factor_forward(pivots, RightHandSides<T, 0>{});
  }
  /// The same as factor() and then solve(), in one pass fewer: the right-hand sides are eliminated while
  /// the divisions of the factorisation are under way.
  template <class Pivots, class B, std::size_t Count>
  void factor_and_solve(Pivots& pivots, const RightHandSides<B, Count>& sides) const {
    factor_forward(pivots, sides);
    back(sides);
  }
  template <class B, std::size_t Count>
  void solve(const RightHandSides<B, Count>& sides) const {
    forward(sides);
    back(sides);
  }

  /// Calls visit(later row, eliminated row, entry of L, entry of U) for every coupling of the factors.
  template <class Visit>
  void for_each_entry(Visit&& visit) const {
    for (std::size_t k = 0; k + 1 < rows_; ++k)
      visit(row(k < middle_ ? k + 1 : k), row(k < middle_ ? k : k + 1), view_.below[k], view_.above[k]);
    if constexpr (Border)
      for (std::size_t k = 0; k < rows_; ++k)
        visit(row(rows_), row(k), view_.below[rows_ + k], view_.above[rows_ + k]);
  }

 private:
  /// One of the two fronts of an elimination. `at` is the place it has reached, with its pivot and the
  /// pivot's error there. `subtracted` and `passed_error` are what elimination of this row takes from the
  /// next place's pivot and adds to its error. `border_lower` and `border_upper` are the border's entries
  /// in this row by now, and `border_sum` and `border_error` what this front takes from the border's pivot
  /// and adds to its error.
  struct Front {
    std::size_t at;
    T pivot, error;
    T subtracted{}, passed_error{};
    T border_lower{}, border_upper{}, border_sum{}, border_error{};
  };
  /// The right-hand sides at a front, and what it will take from the border's.
  template <class B, std::size_t Count>
  struct Sides {
    std::array<B, Count> y;
    std::array<B, Border ? Count : 0> border;
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
  /// The matrix entry in the row at place `i` and the column at place `j`, of coupling c.
  const T& entry(std::size_t i, std::size_t j, std::size_t c) const {
    if constexpr (Symmetric)
      return view_.lower[c];
    else
      return row(i) > row(j) ? view_.lower[c] : view_.upper[c];
  }

  [[nodiscard]] Front start(std::size_t at, std::size_t border_link) const {
    Front front{at, view_.diagonal[row(at)], view_.diagonal[row(at)]};
    if constexpr (Border) {
      front.border_lower = entry(rows_, at, link(border_link));
      front.border_upper = entry(at, rows_, link(border_link));
      front.border_sum = T(0);
      front.border_error = T(0);
    }
    return front;
  }
  template <class B, std::size_t Count>
  Sides<B, Count> start(const RightHandSides<B, Count>& sides, std::size_t at) const {
    Sides<B, Count> result;
    for (std::size_t c = 0; c < Count; ++c) {
      result.y[c] = sides.right[c][row(at)];
      if constexpr (Border) result.border[c] = B(0);
    }
    return result;
  }

  /// Divides the front's row by its pivot; its neighbour is at `next`.
  template <class Pivots>
  void divide(Front& front, std::size_t next, Pivots& pivots) const {
    const std::size_t between = front.at < next ? front.at : next, c = link(between), here = row(front.at);
    const T r = pivots.reciprocal(front.pivot, front.error);
    view_.reciprocal[here] = r;
    const T lower = entry(next, front.at, c), upper = entry(front.at, next, c);
    const T l = lower * r;
    view_.below[between] = l;
    T u = l;  // NOLINT(performance-unnecessary-copy-initialization): it changes where nothing is symmetric
    if constexpr (!Symmetric) {
      u = upper * r;
      view_.above[between] = u;
    }
    // The product of the couplings needs no division, so that it is ready when the reciprocal is.
    front.subtracted = (lower * upper) * r;
    if constexpr (Pivots::follow_errors) front.passed_error = (l * u) * front.error;
    if constexpr (Border) {
      const T border = front.border_lower * r;
      view_.below[rows_ + front.at] = border;
      if constexpr (Pivots::follow_errors)
        front.border_error = front.border_error + (border * border) * front.error;
      if constexpr (!Symmetric) view_.above[rows_ + front.at] = front.border_upper * r;
      front.border_sum = front.border_sum + (front.border_lower * front.border_upper) * r;
      front.border_lower = without_traces(T(-(front.border_lower * u)), view_.diagonal[here]);
      if constexpr (Symmetric)
        front.border_upper = front.border_lower;
      else
        front.border_upper = without_traces(T(-(front.border_upper * l)), view_.diagonal[here]);
    }
  }
  /// Stores the right-hand sides of the front's row and adds what they take from the border's.
  template <class B, std::size_t Count>
  void keep(Sides<B, Count>& at_front, std::size_t at, const RightHandSides<B, Count>& sides) const {
    for (std::size_t c = 0; c < Count; ++c) {
      sides.x[c][row(at)] = at_front.y[c];
      if constexpr (Border) at_front.border[c] = at_front.border[c] + view_.below[rows_ + at] * at_front.y[c];
    }
  }
  template <class B, std::size_t Count>
  void keep_and_move(Sides<B, Count>& at_front, std::size_t at, std::size_t next,
                     const RightHandSides<B, Count>& sides) const {
    const T& l = view_.below[at < next ? at : next];
    keep(at_front, at, sides);
    for (std::size_t c = 0; c < Count; ++c) at_front.y[c] = sides.right[c][row(next)] - l * at_front.y[c];
  }
  /// Completes the right-hand sides of the middle row and of the border once both fronts have arrived.
  /// `other_at` is the last place of the second front before the middle, or the middle itself if the path
  /// is too short for a second front.
  template <class B, std::size_t Count>
  void meet(Sides<B, Count>& front, Sides<B, Count>& other, std::size_t other_at,
            const RightHandSides<B, Count>& sides) const {
    if (other_at > middle_) {
      keep(other, other_at, sides);
      for (std::size_t c = 0; c < Count; ++c) front.y[c] = front.y[c] - view_.below[middle_] * other.y[c];
    }
    keep(front, middle_, sides);
    if constexpr (Border)
      for (std::size_t c = 0; c < Count; ++c) {
        const B& given = sides.right[c][row(rows_)];
        sides.x[c][row(rows_)] =
            other_at > middle_ ? (given - front.border[c]) - other.border[c] : given - front.border[c];
      }
  }

  template <class Pivots, class B, std::size_t Count>
  void factor_forward(Pivots& pivots, const RightHandSides<B, Count>& sides) const {
    // In a ring, link rows_ - 1 couples the last place and the border, link rows_ the border and place 0.
    Front left = start(0, rows_), right = start(rows_ - 1, rows_ - 1);
    Sides<B, Count> left_sides = start(sides, 0), right_sides = start(sides, rows_ - 1);
    const auto eliminate = [&](Front& front, Sides<B, Count>& at_front, std::size_t next) {
      divide(front, next, pivots);
      keep_and_move(at_front, front.at, next, sides);
      front.pivot = view_.diagonal[row(next)] - front.subtracted;
      if constexpr (Pivots::follow_errors) front.error = view_.diagonal[row(next)] + front.passed_error;
      front.at = next;
    };
    while (right.at > middle_ + 1) {
      eliminate(left, left_sides, left.at + 1);
      eliminate(right, right_sides, right.at - 1);
    }
    while (left.at < middle_) eliminate(left, left_sides, left.at + 1);
    if (right.at > middle_) {
      divide(right, middle_, pivots);
      left.pivot = left.pivot - right.subtracted;
      if constexpr (Pivots::follow_errors) left.error = left.error + right.passed_error;
    }
    const std::size_t m = row(middle_);
    const T r = pivots.reciprocal(left.pivot, left.error);
    view_.reciprocal[m] = r;
    if constexpr (Border) {
      const T lower = left.border_lower + right.border_lower, upper = left.border_upper + right.border_upper;
      const T border = lower * r;
      view_.below[rows_ + middle_] = border;
      if constexpr (!Symmetric) view_.above[rows_ + middle_] = upper * r;
      const std::size_t v = row(rows_);
      T error = view_.diagonal[v];
      if constexpr (Pivots::follow_errors)
        error = ((error + left.border_error) + right.border_error) + (border * border) * left.error;
      const T pivot = ((view_.diagonal[v] - left.border_sum) - right.border_sum) - (lower * upper) * r;
      view_.reciprocal[v] = pivots.reciprocal(pivot, error);
    }
    meet(left_sides, right_sides, right.at, sides);
  }

  template <class B, std::size_t Count>
  void forward(const RightHandSides<B, Count>& sides) const {
    std::size_t i = 0, j = rows_ - 1;
    Sides<B, Count> left = start(sides, i), right = start(sides, j);
    for (; j > middle_ + 1; ++i, --j) {
      keep_and_move(left, i, i + 1, sides);
      keep_and_move(right, j, j - 1, sides);
    }
    for (; i < middle_; ++i) keep_and_move(left, i, i + 1, sides);
    meet(left, right, j, sides);
  }

  template <class B, std::size_t Count>
  void back(const RightHandSides<B, Count>& sides) const {
    const T* u = view_.above;
    const T* r = view_.reciprocal;
    std::array<B, Count> left, right, border;
    for (std::size_t c = 0; c < Count; ++c) {
      B* x = sides.x[c];
      left[c] = x[row(middle_)] * r[row(middle_)];
      if constexpr (Border) {
        border[c] = x[row(rows_)] * r[row(rows_)];
        x[row(rows_)] = border[c];
        left[c] = left[c] - u[rows_ + middle_] * border[c];
      }
      x[row(middle_)] = left[c];
    }
    right = left;
    const auto outwards = [&](std::array<B, Count>& nearer, std::size_t at, std::size_t between) {
      for (std::size_t c = 0; c < Count; ++c) {
        B scaled = sides.x[c][row(at)] * r[row(at)];
        if constexpr (Border) scaled = scaled - u[rows_ + at] * border[c];
        nearer[c] = scaled - u[between] * nearer[c];
        sides.x[c][row(at)] = nearer[c];
      }
    };
    std::size_t i = middle_, j = middle_;
    for (; i > 0 && j + 1 < rows_; --i, ++j) {
      outwards(left, i - 1, i - 1);
      outwards(right, j + 1, j);
    }
    for (; i > 0; --i) outwards(left, i - 1, i - 1);
  }

  const EliminationPlan& plan_;
  EliminationView<T> view_;
  std::size_t rows_, middle_;
};

}  // namespace pfaff::detail
