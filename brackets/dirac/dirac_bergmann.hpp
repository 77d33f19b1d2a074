// The algorithm of Dirac and Bergmann at a point: from a Hamiltonian and its primary constraints it finds all
// constraints of the motion.
//
// The motion is that of H + sum_m u_m phi_m over the primary constraints. Each constraint has to stay zero,
//   d/dt phi_a = d_t phi_a + {phi_a, H} + sum_m {phi_a, phi_m} u_m = 0.
// These equations determine some of the multipliers u: elimination chooses rows R and columns C of the matrix
// {phi_a, phi_m} by pivots, with rows of early generations first, and solves them for u_C. With these
// multipliers every other row becomes a condition on the state alone,
//   chi_a = d_t phi_a + {phi_a, H} - {phi_a, phi_C} ({phi_R, phi_C})^-1 (d_t phi_R + {phi_R, H}) = 0.
// Where R and C are the same primary constraints and none depends on time, chi_a is the Dirac bracket of
// phi_a and H with respect to them. A chi whose gradient is independent of those of the constraints known so
// far is a new constraint, which has to stay zero too; the algorithm repeats with it, in the next generation,
// until nothing new is found.
//
// Brackets are recorded as tapes and differentiated exactly. Whether a number is zero is decided by comparing
// it with a bound of its rounding error.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/brackets/dirac/classification.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// A Hamiltonian H(z, t), primary constraints phi_m(z, t) = 0 and the Poisson bracket that acts on them. n is
/// the dimension of z.
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
  irregular,     // a condition without an independent gradient vanishes at the point but not nearby
  unreachable    // from the point given, none was found that fulfils the constraints
};
std::string_view to_string(ConstraintClosure closure);

/// A constraint, given or found. Generation 1 is primary, 2 secondary, and so on.
struct FoundConstraint {
  std::string name;  // the name of its primary constraint, with a prime for each time derivative
  int generation = 1;
};

/// The multiplier of a primary constraint.
template <class T>
struct Multiplier {
  bool determined = false;  // false: arbitrary, or dependent on a multiplier that is
  T value{};                // at the point; meaningful where determined
};

/// What the algorithm has found at a point.
template <class T>
struct ConstraintAlgorithm {
  ConstraintClosure closure = ConstraintClosure::closed;
  std::vector<T> point;  // the point given, moved onto the constraints found
  std::vector<FoundConstraint> constraints;
  std::shared_ptr<const Tape> values;      // n -> one per constraint
  std::vector<Multiplier<T>> multipliers;  // one per primary constraint
  Classification<T> classes;               // of all constraints, at the point
  std::string trouble;                     // where it did not close: what is wrong with which condition
};

/// Runs the algorithm from the point z at time t, through at most so many `generations` of constraints;
/// RunError where a system is not closed by then. InputError where shapes do not fit or a formula is not
/// finite at z. T is double or Quad.
template <class T>
ConstraintAlgorithm<T> dirac_bergmann(const ConstrainedHamiltonian& system, const T& t, In<T> z,
                                      int generations = 10);

/// The result as text: the constraints by generation, how the algorithm ended, the multipliers and the
/// classes, one line each.
template <class T>
std::string describe(const ConstraintAlgorithm<T>& result);

}  // namespace pfaff
