// The formulas that a system's struct may write, and the check that what bears their names is what is meant.
//
// A template whose signature does not fit would be passed over in silence, and the system would offer less
// than its author wrote. So every name is looked up whatever its signature: in a class derived from S and
// from another with a member of that name, the name is ambiguous exactly where S has one too. Data of such a
// name, a parameter `field` say, is no formula.
#pragma once

#include <concepts>
#include <type_traits>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace pfaff::detail {

// S writes a formula that can be called with the scalar T.
template <class S, class T = Recorded>
concept WritesField = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.field(t, z, o);
};
template <class S, class T = Recorded>
concept WritesKinetic = requires(const S& s, const T& t, In<T> p) {
  { s.kinetic(t, p) } -> std::convertible_to<T>;
};
template <class S, class T = Recorded>
concept WritesPotential = requires(const S& s, const T& t, In<T> q) {
  { s.potential(t, q) } -> std::convertible_to<T>;
};
template <class S, class T = Recorded>
concept WritesForce = requires(const S& s, const T& t, In<T> q, Out<T> o) {
  s.force(t, q, o);
};
template <class S, class T = Recorded>
concept WritesVelocity = requires(const S& s, const T& t, In<T> p, Out<T> o) {
  s.velocity(t, p, o);
};
template <class S>
concept WritesDamping = requires(const S& s) {
  { s.damping() } -> std::convertible_to<Real>;
};
template <class S, class T = Recorded>
concept WritesHamiltonian = requires(const S& s, const T& t, In<T> z) {
  { s.hamiltonian(t, z) } -> std::convertible_to<T>;
};
template <class S>
concept WritesBracket = requires(const S& s) {
  s.bracket();
};
template <class S, class T = Recorded>
concept WritesBirkhoffian = requires(const S& s, const T& t, In<T> z) {
  { s.birkhoffian(t, z) } -> std::convertible_to<T>;
};
template <class S, class T = Recorded>
concept WritesOneForm = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.one_form(t, z, o);
};
template <class S, class T = Recorded>
concept WritesStructure = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.structure(t, z, o);
};
template <class S, class T = Recorded>
concept WritesCovector = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.covector(t, z, o);
};
template <class S, class T = Recorded>
concept WritesChart = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.chart(t, z, o);
};
template <class S, class T = Recorded>
concept WritesChartInverse = requires(const S& s, const T& t, In<T> y, Out<T> o) {
  s.chart_inverse(t, y, o);
};
template <class S, class T = Recorded>
concept WritesChartHamiltonian = requires(const S& s, const T& t, In<T> y) {
  { s.chart_hamiltonian(t, y) } -> std::convertible_to<T>;
};
template <class S, class T = Recorded>
concept WritesChartField = requires(const S& s, const T& t, In<T> y, Out<T> o) {
  s.chart_field(t, y, o);
};
template <class S, class T = Recorded>
concept WritesAlpha = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.alpha(t, t, z, z, o, o);
};
template <class S, class T = Recorded>
concept WritesHolonomic = requires(const S& s, const T& t, In<T> q, Out<T> o) {
  s.holonomic(t, q, o);
};
template <class S, class T = Recorded>
concept WritesFriction = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.friction(t, z, o);
};
template <class S, class T = Recorded>
concept WritesConstraints = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.constraints(t, z, o);
};
template <class S, class T = Recorded>
concept WritesConstraintGradients = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.constraint_gradients(t, z, o);
};
template <class S>
concept WritesConstraintCount = requires(const S& s) {
  { s.constraint_count() } -> std::convertible_to<int>;
}
|| requires {
  { S::constraint_count } -> std::convertible_to<int>;
};
template <class S>
concept WritesConstraintEvaluator = requires(const S& s) {
  s.template constraint_evaluator<Recorded>();
};
template <class S>
concept WritesSymmetricBracket = requires(const S& s) {
  s.symmetric_bracket();
};
template <class S, class T = Recorded>
concept WritesEntropy = requires(const S& s, const T& t, In<T> z) {
  { s.entropy(t, z) } -> std::convertible_to<T>;
};
template <class S, class T = Recorded>
concept WritesInvariants = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.invariants(t, z, o);
};
template <class S, class T = Recorded>
concept WritesExactSolution = requires(const S& s, const T& t, In<T> z, Out<T> o) {
  s.exact_solution(t, t, z, o);
};
template <class S>
concept WritesInitial = requires(const S& s, Out<Recorded> o) {
  s.template initial<Recorded>(o);
};

template <class Pointer>
concept PointsToData = std::is_member_object_pointer_v<Pointer> ||
    (std::is_pointer_v<Pointer>&& std::is_object_v<std::remove_pointer_t<Pointer>>);
template <class S, class Named>
struct Joined : S, Named {};

// names_X<S>: S has a member function or template X, of whatever signature.
#define PFAFF_NAMED(name)                   \
  struct Named_##name {                     \
    int name;                               \
  };                                        \
  template <class S>                        \
  constexpr bool names_##name = !requires { \
    &Joined<S, Named_##name>::name;         \
  }                                         \
  &&!requires { requires PointsToData<decltype(&S::name)>; };
PFAFF_NAMED(field)
PFAFF_NAMED(kinetic)
PFAFF_NAMED(potential)
PFAFF_NAMED(force)
PFAFF_NAMED(velocity)
PFAFF_NAMED(damping)
PFAFF_NAMED(hamiltonian)
PFAFF_NAMED(bracket)
PFAFF_NAMED(birkhoffian)
PFAFF_NAMED(one_form)
PFAFF_NAMED(structure)
PFAFF_NAMED(covector)
PFAFF_NAMED(chart)
PFAFF_NAMED(chart_inverse)
PFAFF_NAMED(chart_hamiltonian)
PFAFF_NAMED(chart_field)
PFAFF_NAMED(alpha)
PFAFF_NAMED(holonomic)
PFAFF_NAMED(friction)
PFAFF_NAMED(constraints)
PFAFF_NAMED(constraint_gradients)
PFAFF_NAMED(constraint_evaluator)
PFAFF_NAMED(symmetric_bracket)
PFAFF_NAMED(entropy)
PFAFF_NAMED(invariants)
PFAFF_NAMED(exact_solution)
PFAFF_NAMED(initial)
#undef PFAFF_NAMED

/// Refuses, while S is compiled, members that bear the name of a formula and cannot be called as one, halves
/// of a pair, and a struct without any vector field.
template <class S>
constexpr void check_formulas() {
  static_assert(!std::is_final_v<S>,
                "a system's struct must not be final: its names are looked up by derivation");
  static_assert(WritesField<S> || !names_field<S>,
                "field: expected template <class T> void field(const T& t, In<T> z, Out<T> rate) const");
  static_assert(WritesKinetic<S> || !names_kinetic<S>,
                "kinetic: expected template <class T> T kinetic(const T& t, In<T> p) const");
  static_assert(WritesPotential<S> || !names_potential<S>,
                "potential: expected template <class T> T potential(const T& t, In<T> q) const");
  static_assert(WritesForce<S> || !names_force<S>,
                "force: expected template <class T> void force(const T& t, In<T> q, Out<T> f) const");
  static_assert(WritesVelocity<S> || !names_velocity<S>,
                "velocity: expected template <class T> void velocity(const T& t, In<T> p, Out<T> v) const");
  static_assert(WritesDamping<S> || !names_damping<S>, "damping: expected Real damping() const");
  static_assert(WritesHamiltonian<S> || !names_hamiltonian<S>,
                "hamiltonian: expected template <class T> T hamiltonian(const T& t, In<T> z) const");
  static_assert(WritesBracket<S> || !names_bracket<S>, "bracket: expected a bracket from bracket() const");
  static_assert(WritesBirkhoffian<S> || !names_birkhoffian<S>,
                "birkhoffian: expected template <class T> T birkhoffian(const T& t, In<T> z) const");
  static_assert(
      WritesOneForm<S> || !names_one_form<S>,
      "one_form: expected template <class T> void one_form(const T& t, In<T> z, Out<T> form) const");
  static_assert(WritesStructure<S> || !names_structure<S>,
                "structure: expected template <class T> void structure(const T& t, In<T> z, Out<T> k) const");
  static_assert(WritesCovector<S> || !names_covector<S>,
                "covector: expected template <class T> void covector(const T& t, In<T> z, Out<T> d) const");
  static_assert(WritesChart<S> || !names_chart<S>,
                "chart: expected template <class T> void chart(const T& t, In<T> z, Out<T> y) const");
  static_assert(
      WritesChartInverse<S> || !names_chart_inverse<S>,
      "chart_inverse: expected template <class T> void chart_inverse(const T& t, In<T> y, Out<T> z) const");
  static_assert(
      WritesChartHamiltonian<S> || !names_chart_hamiltonian<S>,
      "chart_hamiltonian: expected template <class T> T chart_hamiltonian(const T& t, In<T> y) const");
  static_assert(
      WritesChartField<S> || !names_chart_field<S>,
      "chart_field: expected template <class T> void chart_field(const T& t, In<T> y, Out<T> rate) const");
  static_assert(WritesAlpha<S> || !names_alpha<S>,
                "alpha: expected template <class T> void alpha(const T& t, const T& t0, In<T> new_z, "
                "In<T> old_z, Out<T> w_hat, Out<T> w) const");
  static_assert(
      WritesHolonomic<S> || !names_holonomic<S>,
      "holonomic: expected template <class T> void holonomic(const T& t, In<T> q, Out<T> phi) const");
  static_assert(
      WritesFriction<S> || !names_friction<S>,
      "friction: expected template <class T> void friction(const T& t, In<T> z, Out<T> lambda) const");
  static_assert(
      WritesConstraints<S> || !names_constraints<S>,
      "constraints: expected template <class T> void constraints(const T& t, In<T> z, Out<T> phi) const");
  static_assert(WritesConstraintGradients<S> || !names_constraint_gradients<S>,
                "constraint_gradients: expected template <class T> void constraint_gradients(const T& t, "
                "In<T> z, Out<T> rows) const");
  static_assert(WritesConstraintEvaluator<S> || !names_constraint_evaluator<S>,
                "constraint_evaluator: expected template <class T> "
                "std::unique_ptr<HolonomicConstraints<T>> constraint_evaluator() const");
  static_assert(WritesSymmetricBracket<S> || !names_symmetric_bracket<S>,
                "symmetric_bracket: expected a bracket from symmetric_bracket() const");
  static_assert(WritesEntropy<S> || !names_entropy<S>,
                "entropy: expected template <class T> T entropy(const T& t, In<T> z) const");
  static_assert(
      WritesInvariants<S> || !names_invariants<S>,
      "invariants: expected template <class T> void invariants(const T& t, In<T> z, Out<T> values) const");
  static_assert(
      WritesExactSolution<S> || !names_exact_solution<S>,
      "exact_solution: expected template <class T> void exact_solution(const T& elapsed, const T& t0, "
      "In<T> z0, Out<T> z) const");
  static_assert(WritesInitial<S> || !names_initial<S>,
                "initial: expected template <class T> void initial(Out<T> z) const");

  static_assert(names_kinetic<S> == names_potential<S>,
                "kinetic and potential belong together, H = T(p) + V(q, t): one of them is missing");
  static_assert(names_birkhoffian<S> == names_one_form<S>,
                "birkhoffian and one_form belong together, F.dz - B dt: one of them is missing");
  static_assert(names_structure<S> == names_covector<S>,
                "structure and covector belong together, K zdot + D = 0: one of them is missing");
  static_assert(!(names_structure<S> && names_birkhoffian<S>),
                "structure and covector are written instead of birkhoffian and one_form, from which they are "
                "derived; expected one pair");
  static_assert(names_chart<S> == names_chart_inverse<S>,
                "chart and chart_inverse belong together: one of them is missing");
  static_assert(
      names_kinetic<S> || !(names_force<S> || names_velocity<S>),
      "force and velocity are written beside kinetic and potential, which are missing; a member that "
      "is something else needs another name");
  static_assert(names_kinetic<S> || !names_damping<S>,
                "damping is written beside kinetic and potential, which are missing");
  static_assert(names_hamiltonian<S> || !names_bracket<S>,
                "bracket is written beside hamiltonian, which is missing");
  static_assert(names_chart<S> || !names_chart_hamiltonian<S>,
                "chart_hamiltonian is written beside chart and chart_inverse, which are missing");
  static_assert(
      names_birkhoffian<S> || names_structure<S> || names_chart_hamiltonian<S> || !names_chart<S>,
      "chart is written beside birkhoffian and one_form, structure and covector, or chart_hamiltonian, which "
      "are missing");
  static_assert(names_birkhoffian<S> || names_structure<S> || (names_kinetic<S> && !names_damping<S>) ||
                    (names_hamiltonian<S> && !names_bracket<S>) || !names_alpha<S>,
                "alpha is written for the structure K of birkhoffian and one_form, of structure and "
                "covector, or of canonical "
                "coordinates, which are missing");
  static_assert(!(names_holonomic<S> && names_constraints<S>),
                "holonomic constraints imply the hidden ones: expected either holonomic or constraints");
  static_assert((names_holonomic<S> || names_constraints<S>) == WritesConstraintCount<S>,
                "constraint_count (a static constexpr int or a member function) and holonomic or constraints "
                "belong together: one of them is missing");
  static_assert(
      (names_kinetic<S> && !names_damping<S>) || (names_hamiltonian<S> && !names_bracket<S>) ||
          !names_holonomic<S>,
      "holonomic is written beside kinetic and potential, or hamiltonian without bracket, which are "
      "missing");
  static_assert((names_kinetic<S> && !names_damping<S>) || names_hamiltonian<S> || !names_constraints<S>,
                "constraints is written beside kinetic and potential, or hamiltonian, which are missing");
  static_assert(names_holonomic<S> || !(names_friction<S> || names_constraint_evaluator<S>),
                "friction and constraint_evaluator are written beside holonomic, which is missing");
  static_assert(names_constraints<S> || !names_constraint_gradients<S>,
                "constraint_gradients is written beside constraints, which is missing");
  static_assert(
      (names_kinetic<S> && !names_damping<S>) || names_hamiltonian<S> || !names_symmetric_bracket<S>,
      "symmetric_bracket is written beside kinetic and potential, or hamiltonian, which are missing");
  static_assert(names_symmetric_bracket<S> || !names_entropy<S>,
                "entropy is written beside symmetric_bracket, which is missing");
  static_assert(names_field<S> || names_kinetic<S> || names_hamiltonian<S> || names_birkhoffian<S> ||
                    names_structure<S>,
                "this system has no vector field; expected one of field, kinetic and potential, hamiltonian, "
                "birkhoffian and one_form, structure and covector");
}

}  // namespace pfaff::detail
