// The members that an integrator's struct may have, and the check that a member with one of these names also
// has the signature expected. What each of them is for is said at the top of core/integrator.hpp.
#pragma once

#include <concepts>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/tolerance.hpp>
#include <pfaff/core/registry/optional_member.hpp>
#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {
enum class Claim;

// Kinds share some names: each kind looks its own up in a namespace of its own.
namespace detail::method {
PFAFF_MEMBER_NAME(Work)
PFAFF_MEMBER_NAME(advance_to)
PFAFF_MEMBER_NAME(processed)
PFAFF_MEMBER_NAME(preprocess)
PFAFF_MEMBER_NAME(kernel)
PFAFF_MEMBER_NAME(postprocess)
PFAFF_MEMBER_NAME(Composed)
PFAFF_MEMBER_NAME(restart)
PFAFF_MEMBER_NAME(hand_over)
// clang-format off
PFAFF_OPTIONAL_MEMBER(order, "int order(const Model& model) const",
                      (const S& s, const Model& model) { { s.order(model) } -> std::same_as<int>; })
PFAFF_OPTIONAL_MEMBER(preserves, "std::vector<Claim> preserves(const Model& model) const",
                      (const S& s, const Model& model) { { s.preserves(model) } -> std::convertible_to<std::vector<Claim>>; })
PFAFF_OPTIONAL_MEMBER(validate, "void validate()", (S& s) { s.validate(); })
PFAFF_OPTIONAL_MEMBER(coefficients, "std::span<Quad> coefficients()",
                      (S& s) { { s.coefficients() } -> std::convertible_to<std::span<Quad>>; })
PFAFF_OPTIONAL_MEMBER(refuses, "std::string refuses(const Model& model) const",
                      (const S& s, const Model& model) { { s.refuses(model) } -> std::convertible_to<std::string>; })
PFAFF_OPTIONAL_MEMBER(instances, "static std::vector<Assignments> instances(bool full)",
                      (bool full) { { S::instances(full) } -> std::convertible_to<std::vector<Assignments>>; })
PFAFF_OPTIONAL_MEMBER(fixed_sizes, "static constexpr bool fixed_sizes", { requires std::same_as<decltype(S::fixed_sizes), const bool>; })
PFAFF_OPTIONAL_MEMBER(compensated, "a member bool compensated", (S& s) { requires std::same_as<decltype((s.compensated)), bool&>; })
// clang-format on
}  // namespace detail::method

namespace detail {

// The problem on which signatures are tried: every facet, in double.
using TriedProblem = Problem<double>;

// True where M can be made into code: it steps in doubles, and in quads, where a time, a step or a state that
// it takes as doubles does not fit.
template <class M>
concept StepsInScalars = Steps<M, TriedProblem> && Steps<M, Problem<Quad>>;

template <class M>
concept WritesWork = requires {
  typename M::template Work<TriedProblem>;
  requires std::constructible_from < typename M::template Work<TriedProblem>,
  const M&, const TriedProblem& > ;
};
template <class M>
concept WritesAdvanceTo = requires(const M& m, const TriedProblem& p, double& t, double end,
                                   const Tolerance<double>& tolerance, State<TriedProblem>& z,
                                   Work<M, TriedProblem>& w) {
  { m.advance_to(p, t, end, tolerance, z, w) } -> std::same_as<Status>;
};
template <class M>
constexpr bool names_processor() {
  return method::has_processed<M> || method::has_preprocess<M> || method::has_kernel<M> ||
         method::has_postprocess<M>;
}
template <class M>
concept WritesComposed = requires(typename M::Composed& composed, const TriedProblem& p, double t,
                                  State<TriedProblem>& z, Work<typename M::Composed, TriedProblem>& w) {
  requires std::default_initializable<typename M::Composed>;
  requires std::same_as < decltype((composed.weights)), std::vector<Quad>
  & > ;
  requires std::same_as<decltype((composed.processor)), std::size_t&>;
  requires WritesProcessor<typename M::Composed, TriedProblem, Work<typename M::Composed, TriedProblem>>;
  { std::as_const(composed).step(p, t, t, z, w) } -> std::same_as<Status>;
};
template <class W>
concept WritesRestart = requires(W& w) {
  { w.restart() } -> std::same_as<void>;
};
template <class W>
concept WritesHandOver = requires(W& w, W& next) {
  w.hand_over(next);
};

/// Refuses, while W is compiled, members of a workspace that bear a name of its protocol and do not fit it.
template <class W>
constexpr void check_work_members() {
  static_assert(!std::is_final_v<W>, "Work must not be final: its members are looked up by derivation");
  static_assert(WritesRestart<W> || !method::names_restart<W>, "restart of Work: expected void restart()");
  static_assert(WritesHandOver<W> || !method::names_hand_over<W>,
                "hand_over of Work: expected void hand_over(Work& next)");
}

/// Refuses, while M is compiled, members that bear the name of an optional one and cannot be used as one, and
/// a struct that does not step.
template <class M>
constexpr void check_method_members() {
  static_assert(WritesWork<M> || !method::has_Work<M>,
                "Work: expected template <class P> struct Work with a constructor Work(const M&, const P&)");
  static_assert(
      Steps<M, TriedProblem>,
      "step: expected template <HasVectorField P> Status step(const P& p, const Scalar<P>& t, const "
      "Scalar<P>& h, State<P>& z, Work<P>& work) const, with whatever facet's concept it needs");
  static_assert(StepsInScalars<M> || !Steps<M, TriedProblem>,
                "step: expected const Scalar<P>& t, const Scalar<P>& h and State<P>& z, and not doubles: "
                "methods step in quad too");
  method::check_order<M>(), method::check_preserves<M>(), method::check_validate<M>();
  method::check_coefficients<M>(), method::check_refuses<M>(), method::check_instances<M>();
  method::check_fixed_sizes<M>(), method::check_compensated<M>();
  static_assert(
      WritesAdvanceTo<M> || !method::has_advance_to<M>,
      "advance_to: expected template <class P> Status advance_to(const P& p, double& t, double end, "
      "const Tolerance<double>& tolerance, State<P>& z, Work<P>& work) const, with Scalar<P> for double "
      "where "
      "it chooses steps in every scalar");
  static_assert(
      WritesProcessor<M, TriedProblem, Work<M, TriedProblem>> || !names_processor<M>(),
      "processed, preprocess, kernel, postprocess: expected bool processed() const and, all three of them, "
      "template <class P> Status preprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, "
      "Work<P>& work) const, with whatever facet's concept they need");
  static_assert(
      WritesComposed<M> || !method::has_Composed<M>,
      "Composed: expected using Composed = Composition<the method without Composed>, or another method "
      "that steps, as a whole and by the parts of a processed step, and has std::vector<Quad> weights and "
      "std::size_t processor");
  check_work_members<Work<M, TriedProblem>>();
}

}  // namespace detail
}  // namespace pfaff
