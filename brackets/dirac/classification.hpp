// Which constraints are second class, which first class and which redundant at a point: the recursion of
// Dirac brackets with pivots (nguyen-turski, Theorems 1 and 2, where the order given may break down).
//
// W_ij = eta(phi_i, phi_j). Each step of the recursion is a Schur complement of W, and chooses the
// constraints it eliminates so that the pivot is large: a pair of best partners where W is skew, one
// constraint or a pair (Bunch & Parlett) where it is symmetric, a row and a column where it is neither. What
// is left when nothing but round-off remains is the first class. The choice depends on the point; recorded
// formulas do not choose, and order_elsewhere() says when a choice made at one point should not be used at
// another.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/bracket.hpp>
#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

enum class ConstraintClass { second, first, redundant };

constexpr std::string_view to_string(ConstraintClass c) {
  return c == ConstraintClass::second  ? "second class"
         : c == ConstraintClass::first ? "first class"
                                       : "redundant";
}

/// One step of the recursion: the constraints whose rows and columns of W it makes zero (indices as given;
/// one or two of each; rows differ from columns only where W is neither symmetric nor skew).
template <class T>
struct Pivot {
  std::vector<std::size_t> rows, columns;
  T value{};  // what the step divides by: eta(a, a), {a, b} of a skew pair, the determinant of another pair
};

/// A linear combination of the constraints, one coefficient for each, at the point alone.
template <class T>
using Combination = std::vector<T>;

/// The classes of constraints at one point.
template <class T>
struct Classification {
  Symmetry symmetry = Symmetry::skew;
  std::vector<ConstraintClass> classes;  // one per constraint
  std::vector<Pivot<T>> pivots;          // in the order of the recursion
  /// Combinations psi with eta(phi_i, psi) = 0 for every i, one per first-class constraint (its coefficient
  /// there is 1, and 0 on the others of the class), in their order.
  std::vector<Combination<T>> null;
  /// The same with eta(psi, phi_i) = 0; differs from `null` only where W is neither symmetric nor skew. Empty
  /// where `principal` is false.
  std::vector<Combination<T>> null_on_left;
  /// Combinations with vanishing gradient, one per redundant constraint (its coefficient is 1).
  std::vector<Combination<T>> dependent;
  /// The 1-norm condition number of W on the second class; 1 where there is none.
  double condition = 1;
  /// False where rows and columns of the pivots are different constraints and no set of constraints was found
  /// whose own brackets have the rank of W, so that there is no Dirac bracket of these constraints (only
  /// where W is neither symmetric nor skew): `classes` calls all of them first class then.
  bool principal = true;
  /// Units in which brackets are compared: scale_i |W_ij| scale_j is about 1 on average; 1 for exact scalars.
  std::vector<double> scale;

  [[nodiscard]] std::size_t rank() const;
  /// Every constraint is second class: the Dirac bracket exists.
  [[nodiscard]] bool regular() const;
  /// The constraints of a class, in the order given.
  [[nodiscard]] std::vector<std::size_t> members(ConstraintClass c) const;
  /// The second class in the order in which the recursion eliminates it.
  [[nodiscard]] std::vector<std::size_t> order() const;
};

/// Classifies constraints with brackets W (square). `gradients` has their gradients in its rows, or no rows
/// where they are not known: nothing is called redundant then. `sizes` has the sums of absolute values of the
/// terms that W was added from, or no rows where |W| is to serve for them. A number counts as zero where it
/// is below the rounding of its terms, 16 K u times their size with the unit round-off u; in exact scalars
/// only zero does. InputError where shapes do not fit or a number is not finite. T is double, Quad or
/// Rational.
template <class T>
Classification<T> classify(const Matrix<T>& w, Symmetry symmetry,
                           const Matrix<T>& gradients = Matrix<T>(0, 0),
                           const Matrix<T>& sizes = Matrix<T>(0, 0));

/// Rows of a matrix that are independent of the rows before them, by orthogonalisation in their order, and
/// for each of the others the combination of rows that vanishes (coefficient 1 on itself).
template <class T>
struct IndependentRows {
  std::vector<std::size_t> independent;
  std::vector<std::size_t> dependent;
  std::vector<Combination<T>> combinations;
};
/// A row counts as dependent where what is left of it is below `tolerance` of `sizes` (one per row; its
/// length where empty). Exact scalars: zero is zero.
template <class T>
IndependentRows<T> independent_rows(const Matrix<T>& rows, double tolerance,
                                    const std::vector<T>& sizes = {});

/// The recursion in a given order, with no choice: (3.8) of nguyen-turski for symmetric and other W, (3.15)
/// for skew W (in pairs of consecutive constraints).
template <class T>
struct PlainRecursion {
  std::vector<T> pivots;  // up to the one that vanishes
  bool works = true;
  std::vector<std::size_t> at;  // the constraints whose pivot vanishes, where it breaks down
};
template <class T>
PlainRecursion<T> plain_recursion(const Matrix<T>& w, Symmetry symmetry, std::span<const std::size_t> order);

/// What becomes of pivots chosen at one point when they are used at another.
struct OrderElsewhere {
  bool good = true;
  std::size_t step = 0;  // the step with the worst pivot
  double ratio = 1;      // that pivot over the best one available there; 0 where it vanishes
};
/// A pivot that is smaller than `accepted` times the best one available at the same step is no longer good:
/// the recursion may magnify errors by 1/accepted there. W may also have another rank there, which is never
/// good.
template <class T>
OrderElsewhere order_elsewhere(const Classification<T>& chosen, const Matrix<T>& w, double accepted = 1e-3);

/// What the classification says, in sentences, a line each, with the names of the constraints.
template <class T>
std::string describe(const Classification<T>& classification, const std::vector<std::string>& names);
/// Where and why a plain order works or breaks down, in one line.
template <class T>
std::string describe(const PlainRecursion<T>& recursion, Symmetry symmetry,
                     std::span<const std::size_t> order, const std::vector<std::string>& names);
/// "phi3 - 2 phi1": a combination with its names, its own constraint first.
template <class T>
std::string describe(const Combination<T>& combination, std::size_t first,
                     const std::vector<std::string>& names);

}  // namespace pfaff
