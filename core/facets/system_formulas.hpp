// The check that a member of a system's struct with the name of a formula also has its signature.
//
// Signatures are compared with the rows in core/facets/formula_rows.hpp, and which members belong together
// with those in core/facets/rule_rows.hpp, one assertion for each rule.
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

  constexpr FormulaMembers has = named_members<S>();
#define PFAFF_RULE(member, condition, message) static_assert(condition, message);
#include <pfaff/core/facets/rule_rows.hpp>
}

}  // namespace pfaff::detail
