// The members that are written of a system, and the check that they belong together, by the rows in
// core/facets/rule_rows.hpp.
//
// What the members make together, such as a separable energy, is said here once: for structs, whose members
// the compiler knows, for models, which are made of whatever their source holds, and for systems as text.
#pragma once

#include <optional>
#include <string_view>

#include <pfaff/core/facets/facet.hpp>

namespace pfaff {

struct ModelSource;

/// Which members are written: the formulas and counts, by the names of their rows, and those that are none.
struct FormulaMembers {
#define PFAFF_FORMULA(name, ...) bool name = false;
#define PFAFF_COUNT(name, member, ...) bool member = false;
#include <pfaff/core/facets/formula_rows.hpp>
  bool bracket = false, symmetric_bracket = false, damping = false, constraint_evaluator = false,
       part_flow = false, small_part = false;
  bool lagrangian = false;  // of a text model, in place of an energy that follows from it

  /// H = T(p, t) + V(q, t), damped or not.
  [[nodiscard]] constexpr bool energies() const { return (kinetic && potential) || lagrangian; }
  [[nodiscard]] constexpr bool conformal() const { return energies() && damping; }
  [[nodiscard]] constexpr bool separable() const { return energies() && !damping; }
  /// An energy that makes a motion by its bracket.
  [[nodiscard]] constexpr bool energy() const { return separable() || hamiltonian; }
  /// The same with the canonical bracket on (q, p).
  [[nodiscard]] constexpr bool canonical() const { return separable() || (hamiltonian && !bracket); }
  /// K zdot + D = 0, of a one-form or written out.
  [[nodiscard]] constexpr bool form() const { return (birkhoffian && one_form) || (structure && covector); }
};

/// The members of which a source has something.
FormulaMembers members_of(const ModelSource& source);

/// A rule that does not hold: the member where it is broken, or nothing, and a message that says what was
/// expected.
struct BrokenRule {
  std::string_view member, message;
};
/// The first rule that does not hold; nullopt where the members belong together.
std::optional<BrokenRule> broken_rule(const FormulaMembers& has);
/// InputError, naming the system, where the members of a source do not belong together.
void check_source(const ModelSource& source);

}  // namespace pfaff
