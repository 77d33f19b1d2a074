// What the struct of a formulation may have for members: how each is called, and the messages of the compiler
// where one has a name that is known and cannot be called so. The list for authors is that at the top of
// core/formulation.hpp.
#pragma once

#include <concepts>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/formulation_statement.hpp>
#include <pfaff/core/registry/optional_member.hpp>
#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

// Kinds share some names: each kind looks its own up in a namespace of its own.
namespace detail::formulation {
PFAFF_MEMBER_NAME(field)
// clang-format off
PFAFF_OPTIONAL_MEMBER(hamiltonian_tape, "Tape hamiltonian_tape(const Model& model) const",
                      (const S& s, const Model& model) { { s.hamiltonian_tape(model) } -> std::same_as<Tape>; })
PFAFF_OPTIONAL_MEMBER(field_tape, "Tape field_tape(const Model& model) const",
                      (const S& s, const Model& model) { { s.field_tape(model) } -> std::same_as<Tape>; })
PFAFF_OPTIONAL_MEMBER(refuses, "std::string refuses(const Model& model) const",
                      (const S& s, const Model& model) { { s.refuses(model) } -> std::same_as<std::string>; })
PFAFF_OPTIONAL_MEMBER(keeps, "std::vector<FormulationClaim> keeps() const",
                      (const S& s) { { s.keeps() } -> std::convertible_to<std::vector<FormulationClaim>>; })
PFAFF_OPTIONAL_MEMBER(friction, "FrictionForm friction() const", (const S& s) { { s.friction() } -> std::same_as<FrictionForm>; })
PFAFF_OPTIONAL_MEMBER(instances, "static std::vector<Assignments> instances(bool full)",
                      (bool full) { { S::instances(full) } -> std::convertible_to<std::vector<Assignments>>; })
// clang-format on
}  // namespace detail::formulation

namespace detail {

// Constraints is HolonomicConstraints or VelocityConstraints.
template <class F, template <class> class Constraints>
concept WritesFormulationWork = requires {
  typename F::template Work<double>;
  requires std::constructible_from < typename F::template Work<double>,
  const F&, Constraints<double>& > ;
};
template <class F, template <class> class Constraints>
concept WritesFormulationField = requires(const F& f, Constraints<double>& constraints, const double& t,
                                          In<double> z, Out<double> rate,
                                          typename F::template Work<double>& work) {
  { f.field(constraints, t, z, z, rate, rate, work) } -> std::same_as<Status>;
};
template <class F, template <class> class Constraints>
concept MovesConstraints = WritesFormulationWork<F, Constraints> && WritesFormulationField<F, Constraints>;
/// True for formulations of velocity constraints, whether they make a field or an energy.
template <class F>
constexpr bool of_velocities = formulation::writes_hamiltonian_tape<F> ||
                               (MovesConstraints<F, VelocityConstraints> &&
                                !MovesConstraints<F, HolonomicConstraints>);
/// Refuses, while F is compiled, a struct that makes no field, and members that bear the name of an optional
/// one and cannot be used as one.
template <class F>
constexpr void check_formulation_members() {
  formulation::check_hamiltonian_tape<F>(), formulation::check_field_tape<F>();
  static_assert(
      !formulation::has_hamiltonian_tape<F> || !(formulation::has_field<F> || formulation::has_field_tape<F>),
      "hamiltonian_tape and field or field_tape make two motions of a system: expected one of them");
  if constexpr (!formulation::has_hamiltonian_tape<F>) {
    static_assert(
        WritesFormulationWork<F, HolonomicConstraints> || WritesFormulationWork<F, VelocityConstraints>,
        "Work: expected template <class T> struct Work with a constructor Work(const F&, "
        "HolonomicConstraints<T>&) or Work(const F&, VelocityConstraints<T>&)");
    static_assert(
        MovesConstraints<F, HolonomicConstraints> || MovesConstraints<F, VelocityConstraints>,
        "field: expected template <class T> Status field(HolonomicConstraints<T>& constraints, const "
        "T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate, Work<T>& work) const, or the same of "
        "VelocityConstraints<T>& where Work takes these");
  }
  static_assert(!(formulation::has_field_tape<F> && of_velocities<F>),
                "field_tape is written beside a field of holonomic constraints, which is missing");
  formulation::check_refuses<F>(), formulation::check_keeps<F>();
  formulation::check_friction<F>(), formulation::check_instances<F>();
}

}  // namespace detail

}  // namespace pfaff
