// The check that a member of a system's struct with the name of a formula also has its signature.
//
// Signatures are compared with the rows in core/facets/formula_rows.hpp. Which members belong together is not
// in the rows: it is written out here, one assertion for each rule.
#pragma once

#include <pfaff/core/facets/written_formulas.hpp>

namespace pfaff::detail {

/// Refuses, while S is compiled, members that bear the name of a formula and cannot be called as one, halves
/// of a pair, and a struct without any vector field.
template <class S>
constexpr void check_formulas() {
  static_assert(!std::is_final_v<S>,
                "a system's struct must not be final: its names are looked up by derivation");
#define PFAFF_FORMULA(name, result, signature, ...)                   \
  static_assert(writes<S, Formula::name> || !names<S, Formula::name>, \
                #name ": expected template <class T> " #result " " #name #signature " const");
#define PFAFF_BRACKET(name, member, ...)                                      \
  static_assert(ReturnsBracket<S, Formula::name> || !names<S, Formula::name>, \
                #member ": expected a bracket from " #member "() const");
#include <pfaff/core/facets/formula_rows.hpp>
  static_assert(WritesDamping<S> || !NamedDamping::named<S>, "damping: expected Real damping() const");
  static_assert(WritesConstraintEvaluator<S> || !NamedConstraintEvaluator::named<S>,
                "constraint_evaluator: expected template <class T> "
                "std::unique_ptr<HolonomicConstraints<T>> constraint_evaluator() const");
  static_assert(WritesPartFlow<S> || !NamedPartFlow::named<S>,
                "part_flow: expected template <class T> Status part_flow(std::size_t part, const T& h, In<T> "
                "z, Out<T> change) const");
  static_assert(WritesInitial<S> || !NamedInitial::named<S>,
                "initial: expected template <class T> void initial(Out<T> z) const");

  // What belongs together.
  using enum Formula;
  constexpr bool separable = names<S, kinetic> && !NamedDamping::named<S>;
  constexpr bool canonical = separable || (names<S, hamiltonian> && !names<S, poisson_tensor>);
  static_assert(names<S, kinetic> == names<S, potential>,
                "kinetic and potential belong together, H = T(p, t) + V(q, t): one of them is missing");
  static_assert(names<S, birkhoffian> == names<S, one_form>,
                "birkhoffian and one_form belong together, F.dz - B dt: one of them is missing");
  static_assert(names<S, structure> == names<S, covector>,
                "structure and covector belong together, K zdot + D = 0: one of them is missing");
  static_assert(!(names<S, structure> && names<S, birkhoffian>),
                "structure and covector are written instead of birkhoffian and one_form, from which they are "
                "derived; expected one pair");
  static_assert(names<S, chart> == names<S, chart_inverse>,
                "chart and chart_inverse belong together: one of them is missing");
  static_assert(
      names<S, kinetic> || !(names<S, force> || names<S, velocity>),
      "force and velocity are written beside kinetic and potential, which are missing; a member that "
      "is something else needs another name");
  static_assert(names<S, kinetic> || !NamedDamping::named<S>,
                "damping is written beside kinetic and potential, which are missing");
  static_assert(names<S, hamiltonian> || !names<S, poisson_tensor>,
                "bracket is written beside hamiltonian, which is missing");
  static_assert(names<S, chart> || !names<S, chart_hamiltonian>,
                "chart_hamiltonian is written beside chart and chart_inverse, which are missing");
  static_assert(
      names<S, birkhoffian> || names<S, structure> || names<S, chart_hamiltonian> || !names<S, chart>,
      "chart is written beside birkhoffian and one_form, structure and covector, or chart_hamiltonian, which "
      "are missing");
  static_assert(names<S, birkhoffian> || names<S, structure> || canonical || !names<S, alpha>,
                "alpha is written for the structure K of birkhoffian and one_form, of structure and "
                "covector, or of canonical "
                "coordinates, which are missing");
  static_assert(!(names<S, holonomic> && names<S, constraints>),
                "holonomic constraints imply the hidden ones: expected either holonomic or constraints");
  static_assert((names<S, holonomic> || names<S, constraints>) == counts_constraints<S>,
                "constraint_count (a static constexpr int or a member function) and holonomic or constraints "
                "belong together: one of them is missing");
  static_assert(
      canonical || !names<S, holonomic>,
      "holonomic is written beside kinetic and potential, or hamiltonian without bracket, which are "
      "missing");
  static_assert(separable || names<S, hamiltonian> || !names<S, constraints>,
                "constraints is written beside kinetic and potential, or hamiltonian, which are missing");
  static_assert(names<S, holonomic> || !(names<S, friction> || NamedConstraintEvaluator::named<S>),
                "friction and constraint_evaluator are written beside holonomic, which is missing");
  static_assert(
      canonical || !names<S, applied_force>,
      "applied_force is written beside kinetic and potential, or hamiltonian without bracket, which are "
      "missing; beside damping, add -nu p to applied_force instead");
  static_assert(
      !names<S, applied_force> || !(names<S, constraints> || names<S, symmetric_tensor> || names<S, alpha> ||
                                    NamedConstraintEvaluator::named<S>),
      "applied_force stands beside an energy, holonomic and velocity constraints; expected no constraints, "
      "symmetric_bracket, alpha or constraint_evaluator");
  static_assert(names<S, constraints> || !names<S, constraint_gradients>,
                "constraint_gradients is written beside constraints, which is missing");
  static_assert(names<S, velocity_constraints> == counts_velocity_constraints<S>,
                "velocity_constraint_count and velocity_constraints belong together: one of them is missing");
  static_assert(names<S, velocity_constraints> || !names<S, velocity_offsets>,
                "velocity_offsets is written beside velocity_constraints, which is missing");
  static_assert(canonical || !names<S, velocity_constraints>,
                "velocity_constraints is written beside kinetic and potential, or hamiltonian without "
                "bracket, which are missing");
  static_assert(!(names<S, velocity_constraints> && names<S, constraints>),
                "velocity_constraints stand beside holonomic constraints, or alone: expected no constraints");
  static_assert(NamedPartFlow::named<S> == counts_parts<S>,
                "part_count (a static constexpr int or a member function) and part_flow belong together: one "
                "of them is missing");
  static_assert(NamedPartFlow::named<S> || !WritesSmallPart<S>,
                "small_part is written beside part_flow, which is missing");
  static_assert(
      separable || names<S, hamiltonian> || !names<S, symmetric_tensor>,
      "symmetric_bracket is written beside kinetic and potential, or hamiltonian, which are missing");
  static_assert(names<S, symmetric_tensor> || !names<S, entropy>,
                "entropy is written beside symmetric_bracket, which is missing");
  static_assert(names<S, field> || names<S, kinetic> || names<S, hamiltonian> || names<S, birkhoffian> ||
                    names<S, structure>,
                "this system has no vector field; expected one of field, kinetic and potential, hamiltonian, "
                "birkhoffian and one_form, structure and covector");
}

}  // namespace pfaff::detail
