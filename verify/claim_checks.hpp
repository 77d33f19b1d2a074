// How each claim about a method is measured, and a false claim of each kind that must be rejected.
//
// The claims themselves, with their meanings and scopes, are the rows of core/facets/claim_rows.hpp. A
// measure takes one step of a method and returns a residual relative to the sizes of its terms: at round-off
// where the claim holds, not-a-number where the step does not converge. The measures are in one file for each
// family of claims (*_claims.cpp); the table that pairs claims with measures is in claim_checks.cpp.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include <pfaff/verify/check.hpp>
#include <pfaff/verify/measured_step.hpp>

namespace pfaff {

/// A method and a system, within the scope of a claim, for which the claim is false.
struct FalseClaim {
  std::string_view method;  // registered
  std::string_view system;  // registered, or the name of the system that `model` makes
  // A parameter of the registered system and its value, where the default does not show that the claim is
  // false.
  std::string_view key = {}, value = {};
  std::string_view method_key = {}, method_value = {};  // the same of the method
  std::shared_ptr<const Model> (*model)() = nullptr;    // not null where no registered system is in the scope
};

/// How one claim is measured.
struct ClaimCheck {
  Claim claim;
  struct {
    double (*in_double)(MeasuredStep<double>& step);
    double (*in_quad)(MeasuredStep<Quad>& step);
  } measure;
  FalseClaim control;
  /// True where the claim is about the rounding of double itself, so that there is no measure in quad. It
  /// takes long runs: it is measured only of methods that make the claim, and not on random systems, most of
  /// which the motion leaves. Its residual is in units of what is allowed.
  bool of_rounding = false;
  /// True where the measure needs the Jacobian of the step; such measures are skipped for systems with many
  /// coordinates, where they cost too much.
  bool from_jacobian = false;
  /// The systems on which the residual is also measured and shown for methods that do not make the claim;
  /// null for every system in the scope of the claim.
  bool (*shown_on)(const Model& model) = nullptr;
};

/// The measure of one claim in the scalar T; not-a-number where a step does not converge, and where there is
/// no measure in T.
template <class T>
double residual_of(const ClaimCheck& row, MeasuredStep<T>& step) {
  if constexpr (std::is_same_v<T, Quad>) {
    return row.measure.in_quad != nullptr ? row.measure.in_quad(step) : no_step;
  } else {
    return row.measure.in_double(step);
  }
}
/// The largest residual of the claim with which it holds.
template <class T>
double largest_allowed(const ClaimCheck& row) {
  return row.of_rounding ? 1 : tolerance<T>();
}

/// check_method without the claims that take long runs.
std::vector<Check> check_in_short_runs(const MethodInstance& method, const Assignments& parameters,
                                       const std::string& system, const std::shared_ptr<const Model>& model);

/// One row for each claim, in the order of the list of claims.
std::span<const ClaimCheck> claim_checks();

// structure_claims.cpp: from the Jacobian of the step

/// The residual of the model's own structure as KeptStructure defines it: M^T K(z', t') M - K(z, t), M Pi(z,
/// t) M^T - Pi(z', t'), or M^T J M - J between tangent vectors.
template <class T>
double own_structure_residual(MeasuredStep<T>& step);
/// M^T J M - e^{-nu h} J.
template <class T>
double conformal_residual(MeasuredStep<T>& step);
/// det M - 1.
template <class T>
double volume_residual(MeasuredStep<T>& step);

// symmetry_claims.cpp

/// The distance from the start after a step of h and a step of -h.
template <class T>
double symmetry_residual(MeasuredStep<T>& step);
/// The distance from the start after the reversal rho, a step, rho again and a step of the same size.
template <class T>
double reversibility_residual(MeasuredStep<T>& step);

// invariant_claims.cpp: numbers at both ends of the step

/// The largest change of a conserved quadratic form.
template <class T>
double quadratic_invariants_residual(MeasuredStep<T>& step);
/// The largest change of a conserved p^T (D q + d).
template <class T>
double momentum_maps_residual(MeasuredStep<T>& step);
/// The largest change of a conserved p^T (D q + d) along directions that velocity constraints allow.
template <class T>
double nonholonomic_momentum_residual(MeasuredStep<T>& step);
/// A system for the control: a bead that slides in a bowl under a velocity constraint, which lets it go
/// round.
std::shared_ptr<const Model> bead_in_a_bowl();
/// The change of the energy H.
template <class T>
double energy_residual(MeasuredStep<T>& step);
/// The largest change of a Casimir of the bracket.
template <class T>
double casimirs_residual(MeasuredStep<T>& step);
/// The largest fall of S in one of forty steps.
template <class T>
double entropy_residual(MeasuredStep<T>& step);

// round_off_claim.cpp

/// By how much the growth of round-off exceeds a random walk (excess_over_random_walk), from states near the
/// start of the step, or near the system's initial state where a run from there goes off. Where the claim
/// seems to fail it has to fail for a second ensemble, too: the smaller of the two is the residual.
/// Not-a-number also where truncation is in sight at every step that is tried.
double round_off_residual(MeasuredStep<double>& step);

// surface_claims.cpp: what is left of equations at the end of the step

/// The largest residual of both levels of holonomic constraints, phi and phi~.
template <class T>
double constraints_residual(MeasuredStep<T>& step);
/// The largest residual of the constraints of velocities.
template <class T>
double velocity_constraints_residual(MeasuredStep<T>& step);
/// A system for the controls: a blade that slides and turns on a plane under one velocity constraint. Its
/// vector field contains the exact reaction of the constraint.
std::shared_ptr<const Model> sliding_blade();

}  // namespace pfaff
