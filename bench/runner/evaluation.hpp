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
/// status, rhs, energy, energy_rate; for systems K zdot + D = 0 also K, F_t, D, F, B, regular, class,
/// self_adjoint (residuals relative to their largest terms), condition, kernel (a basis, one list per
/// direction) and centre (null where F and B are the author's). Numbers in double, strings in quad, null
/// where not finite or where there is no such quantity; status is that of a solve (converged, singular,
/// non_finite). A system without F and B has them about its initial state, else about the state, unless a
/// centre is given. InputError for a centre where there is no K.
nlohmann::json evaluation(const EvaluationSettings& settings);

}  // namespace pfaff
