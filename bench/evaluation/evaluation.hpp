// A system evaluated at one state and time: everything its formulas give there.
#pragma once

#include <optional>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/bench/runner/settings.hpp>

namespace pfaff {

/// What to evaluate, and in which precision.
struct EvaluationSettings {
  ResolvedState at;
  Precision precision = Precision::double_precision;
  std::optional<std::vector<Real>> centre;  // of the inverse problem; evaluation() says what stands in for it
};

/// The content of `pfaff evaluate --json`. Numbers are JSON numbers in double and strings in quad; null where
/// a number is not finite or the quantity does not exist.
///
/// Every system has schema, system, parameters, precision, t, coordinates, state, status (of the solve for
/// the rate: converged, singular, non_finite), rhs, energy, energy_rate, and a reason, in one line, where
/// there is no rhs.
///
/// Systems with constraints also have formulation and its parameters, constraint_names and constraints. Where
/// the constraints have Poisson brackets, these are added:
/// - W, the matrix of all brackets. Holonomic constraints stand in pairs: each phi is followed by its phi~.
/// - rank and condition of W (condition is null where W is singular), first_class and redundant (names).
/// - dirac_bracket, the brackets of the coordinates.
/// - solvers {name: {rhs, difference, status}}: Dirac's formulation by every solver that applies, and its
/// largest difference from the structured one, relative to max(1, |x|).
///
/// Holonomic constraints also have hidden_constraints, structure (of S), S, A, S_D (null without friction)
/// and multipliers, the lambda of S lambda = P (F - friction v - p'). W and what follows from it are given
/// for up to 200 constraints, the solvers by determinants for up to 60.
///
/// Constraints of velocities also have
/// - structure (of S), velocity_rows, the rows of A, velocity_names, which name rows of both, and S; where
/// they move, multipliers, the lambda of S lambda = A H_pp (-H_q - p'), and constraint_forces, -A^T lambda;
/// - nonholonomic: P, the projector onto admissible velocities; bracket, the tensor Pibar at the momenta that
/// P^T projects onto the constraints; its rank, its casimirs (names) with casimir_residual, the largest of
/// |Pibar d psi| relative to its terms, and one_form_residual, that of the covectors (A_alpha, 0);
/// jacobiator, the largest {x, {y, z}} + {y, {z, x}} + {z, {x, y}} of three coordinates (value, of);
/// flow_difference, |Pibar grad H - rhs|, which is round-off where b = 0 and nothing depends on time. Null
/// where H is not quadratic in the momenta, where constraints depend on each other (the reason says which),
/// and for more than 40 positions.
///
/// Systems K zdot + D = 0 also have K, F_t, D, F, B, regular, class, self_adjoint (residuals relative to
/// their largest terms), condition, kernel (a basis, one list per direction) and centre (null where F and B
/// are the author's). Where a system does not give F and B, they are constructed about the given centre, by
/// default about the initial state of the system, or about the evaluated state where it has none. InputError
/// for a centre where there is no K.
nlohmann::json evaluation(const EvaluationSettings& settings);

}  // namespace pfaff
