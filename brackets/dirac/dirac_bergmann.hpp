// The algorithm of Dirac and Bergmann at a point: from a Hamiltonian and primary constraints to all of them.
//
// The motion is that of H + sum_m u_m phi_m over the primary constraints. Each constraint has to stay zero,
//   d/dt phi_a = d_t phi_a + {phi_a, H} + sum_m {phi_a, phi_m} u_m = 0,
// which determines some of the multipliers u (rows R and columns C of {phi_a, phi_m} chosen by pivots, rows
// of early generations first) and leaves for the other rows
//   chi_a = d_t phi_a + {phi_a, H} - {phi_a, phi_C} ({phi_R, phi_C})^-1 (d_t phi_R + {phi_R, H}) = 0.
// Where R and C are the same primary constraints, that is {phi_a, H} in their Dirac bracket. A chi whose
// gradient is independent of the constraints known is a new one; the next generation follows from it.
// Brackets are tapes, differentiated exactly; whether a number is zero is decided by its rounding errors.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// H(z, t) and primary constraints phi_m(z, t) = 0 with a Poisson bracket.
struct ConstrainedHamiltonian {
  std::shared_ptr<const Tape> hamiltonian;  // n -> 1
  std::shared_ptr<const Tape> sharp;        // (z, covector): 2 n -> n, skew
  std::shared_ptr<const Tape> primary;      // n -> number of primary constraints
  std::vector<std::string> names;           // of the primary constraints
};

/// How the algorithm ended.
enum class ConstraintClosure {
  closed,        // every constraint stays zero
  inconsistent,  // a condition is a number other than zero: there is no motion
  irregular,     // a condition vanishes at the point and not nearby, with a gradient that is not independent
  unreachable    // no point that fulfils the constraints found from the one given
};
std::string_view to_string(ConstraintClosure closure);

/// A constraint that was found, or given: generation 1 is primary, 2 secondary, ...
struct FoundConstraint {
  std::string name;  // a prime for each time derivative
  int generation = 1;
};

/// The multiplier of a primary constraint.
template <class T>
struct Multiplier {
  bool determined = false;  // else arbitrary, or tied to others that are
  T value{};                // where determined; at the point
};

/// What was found at a point.
template <class T>
struct ConstraintAlgorithm {
  ConstraintClosure closure = ConstraintClosure::closed;
  std::vector<T> point;  // on the constraints found, next to the one given
  std::vector<FoundConstraint> constraints;
  std::shared_ptr<const Tape> values;      // n -> one per constraint
  std::vector<Multiplier<T>> multipliers;  // one per primary constraint
  Classification<T> classes;               // of all constraints, at the point
  std::string trouble;                     // names the condition where it did not close
};

/// Runs the algorithm from z at time t. At most `generations`; a system that is not closed by then throws
/// RunError. InputError where shapes do not fit or a formula is not finite at z. T is double or Quad.
template <class T>
ConstraintAlgorithm<T> dirac_bergmann(const ConstrainedHamiltonian& system, const T& t, In<T> z,
                                      int generations = 10);

/// Constraints by generation, how it closes, multipliers and classes: a line each.
template <class T>
std::string describe(const ConstraintAlgorithm<T>& result);

}  // namespace pfaff
