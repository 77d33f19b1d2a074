// A system at one point: everything its formulas give there.
#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include <pfaff/bench/runner/settings.hpp>

namespace pfaff {

/// What to look at, and how.
struct EvaluationSettings {
  ResolvedState at;
  Precision precision = Precision::double_precision;
  std::optional<std::vector<Real>> centre;  // of the inverse problem; the system's own F and B without
};

/// The content of `pfaff evaluate --json`: schema, system, parameters, precision, t, coordinates, state,
/// status, rhs, energy, energy_rate, and a reason in one line where there is no rhs.
///
/// With constraints also formulation and its parameters, constraint_names, constraints, W (brackets of all of
/// them; of holonomic ones each phi is followed by its phi~), rank, condition (of W, null where singular),
/// first_class and redundant (names), dirac_bracket (of the coordinates), solvers {name: {rhs, difference,
/// status}}: Dirac's formulation by every solver that applies, and its largest difference from the structured
/// one, relative to max(1, |x|). Of holonomic constraints also hidden_constraints, structure (of S), S, A,
/// S_D (null without friction), multipliers: S lambda = P (F - friction v - p'). W and what follows from it
/// up to 200 constraints, determinants up to 60.
///
/// For systems K zdot + D = 0 also K, F_t, D, F, B, regular, class,
/// self_adjoint (residuals relative to their largest terms), condition, kernel (a basis, one list per
/// direction) and centre (null where F and B are the author's). Numbers in double, strings in quad, null
/// where not finite or where there is no such quantity; status is that of a solve (converged, singular,
/// non_finite). A system without F and B has them about its initial state, else about the state, unless a
/// centre is given. InputError for a centre where there is no K.
nlohmann::json evaluation(const EvaluationSettings& settings);

}  // namespace pfaff
