// What a solver of the Dirac bracket is given, and the order in which recursive ones eliminate.
#pragma once

#include <span>
#include <vector>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/linear/pivot.hpp>

namespace pfaff {

/// K constraints of a bracket on n coordinates, and one covector alpha, at a state. Matrices are row-major.
template <class T>
struct DiracData {
  std::size_t dimension = 0, count = 0;
  Symmetry symmetry = Symmetry::skew;
  In<T> gradients;  // K x n: dphi_i
  In<T> sharps;     // K x n: X_i = sharp(dphi_i)
  In<T> gram;       // K x K: W_ij = eta(phi_i, phi_j) = dphi_i.X_j
  In<T> covector;   // n: alpha
  In<T> vector;     // n: sharp(alpha)
  In<T> brackets;   // K: r_j = dphi_j.sharp(alpha)
  In<T> tensor;     // n x n, of the base bracket; empty unless the solver asks for it
  /// The coordinates in which X_i may differ from zero: support[support_begin[i]] up to support_begin[i + 1].
  /// Empty: all of them. With it, what follows a structured solve is O(K) too.
  std::span<const std::size_t> support_begin{}, support{};
};

/// The steps of an elimination: constraints whose rows and columns of W one step makes zero; one or two.
struct EliminationStep {
  std::vector<std::size_t> rows, columns;
};
using EliminationOrder = std::vector<EliminationStep>;

/// The order given: (3.15) of nguyen-turski in pairs for skew brackets, (3.8) one by one for others.
inline EliminationOrder plain_order(std::size_t count, Symmetry symmetry) {
  EliminationOrder order;
  if (symmetry == Symmetry::skew) {
    for (std::size_t i = 0; i + 1 < count; i += 2) order.push_back({{i, i + 1}, {i, i + 1}});
    if (count % 2 != 0) order.push_back({{count - 1}, {count - 1}});
  } else {
    for (std::size_t i = 0; i < count; ++i) order.push_back({{i}, {i}});
  }
  return order;
}

/// The order that a classification found good at its point.
template <class T>
EliminationOrder pivoted_order(const Classification<T>& classification) {
  EliminationOrder order;
  for (const Pivot<T>& pivot : classification.pivots) order.push_back({pivot.rows, pivot.columns});
  return order;
}

namespace detail {

/// False for a pivot that is zero or not finite, which ends an elimination. Formulas that are being recorded
/// have no numbers to inspect, so that every pivot is taken for usable.
template <class T>
bool usable_pivot(const T& pivot) {
  if constexpr (has_numbers<T>) {
    const Value<T> x = value_of(pivot);
    return isfinite(x) && !(abs(x) == Value<T>(0));
  } else {
    return true;
  }
}

/// The coefficients x of a step's columns such that G[rows, columns] x = right.
template <class T>
struct StepCoefficients {
  T first{}, second{};
};

/// Solves the pivot block of a step: `entry(i, j)` is G_ij, `right(i)` the right-hand side.
template <class T, class Entry, class Right>
bool solve_step(const EliminationStep& step, Symmetry symmetry, const Entry& entry, const Right& right,
                StepCoefficients<T>& x) {
  const std::size_t a = step.rows[0], c = step.columns[0];
  if (step.rows.size() == 1) {
    const T pivot = entry(a, c);
    if (!usable_pivot(pivot)) return false;
    x.first = right(a) / pivot;
    return true;
  }
  const std::size_t b = step.rows[1], d = step.columns[1];
  if (symmetry == Symmetry::skew) {  // (3.15)
    const T pivot = entry(a, b);
    if (!usable_pivot(pivot)) return false;
    x.first = -(right(b) / pivot);
    x.second = right(a) / pivot;
    return true;
  }
  const T ac = entry(a, c), ad = entry(a, d), bc = entry(b, c), bd = entry(b, d);
  const T determinant = ac * bd - ad * bc;
  if (!usable_pivot(determinant)) return false;
  x.first = (bd * right(a) - ad * right(b)) / determinant;
  x.second = (ac * right(b) - bc * right(a)) / determinant;
  return true;
}

}  // namespace detail
}  // namespace pfaff
