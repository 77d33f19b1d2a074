// Checks: every claim of every plug-in, measured, with its tolerance and its controls.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

/// pass: the claim holds. fail: it does not. measured: outside the claim's scope, shown only. rejected: a
/// control, a claim known to be false, was found to be false, as it must be. skipped: was not measured, with
/// the reason.
enum class CheckResult { pass, fail, measured, rejected, skipped };
std::string_view to_string(CheckResult result);

struct Check {
  std::string plugin, claim, scope, system, precision;
  Assignments parameters;
  double measured = 0, expected = 0, tolerance = 0;
  bool in_scope = true, control = false;
  CheckResult result = CheckResult::skipped;
  std::string reason;
};

/// True where a check is as it should be: claims in scope pass, controls are rejected; out of scope, what was
/// measured is fine whatever it is, and what was skipped gives its reason.
bool good(const Check& check);

nlohmann::json to_json(const Check& check);

/// A point on a system where claims are measured: the initial state moved off any symmetry, at a time that is
/// not 0, and where there are constraints back onto them. InputError when the model has no initial state, or
/// no such point was found.
std::vector<Real> generic_state(const Model& model);
inline const Real generic_time = Real::fraction(37, 100);

/// The model, or where it has constraints and no vector field its motion in Dirac's formulation.
std::shared_ptr<const Model> motion_of(const std::shared_ptr<const Model>& model);

/// Measured order of a method from local errors in quad against Taylor series: log2 of successive errors
/// under halving of the step, minus one, taken down until three slopes agree to 0.02, or, where round-off
/// comes first, extrapolated from the last two. Of methods that need holonomic constraints, from errors at
/// the end of a fixed interval instead: momenta of central differences, which do not accumulate their errors,
/// are as good as the positions there. Methods with double coefficients are measured in quad arithmetic down
/// to the error of their coefficients.
struct MeasuredOrder {
  double slope = 0;
  bool settled = false;
  std::string reason;  // when nothing could be measured
};
MeasuredOrder measure_order(const MethodInstance& method, const std::shared_ptr<const Model>& model);
/// The slope as the step falls to 1e-10 by factors of ten: where a wrong coefficient shows.
double order_at_small_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model);

/// Checks of one method with given parameters on one system, in double and quad.
std::vector<Check> check_method(const MethodPlugin& plugin, const Assignments& parameters,
                                const SystemPlugin& system);
/// The method with one coefficient changed by 1e-6 must lose its order or its structure.
std::vector<Check> check_changed_coefficient(const MethodPlugin& plugin, const Assignments& parameters,
                                             const SystemPlugin& system);
/// Structure, chart, overrides, invariants and exact solution of a system.
std::vector<Check> check_system(const SystemPlugin& system);
/// Of a system with constraints: that it starts on them, that they are second class there, that what was
/// written of them is what is derived (named constraint by constraint), and that Dirac's formulation keeps
/// them off their surface too.
std::vector<Check> check_constraints(const std::string& name, const std::shared_ptr<const Model>& model);
/// Of a metriplectic system: its symmetric bracket, the degeneracy conditions, what energy and entropy do.
std::vector<Check> check_metriplectic(const std::string& name, const Model& model);
/// Symmetry and Jacobi identity of a bracket.
std::vector<Check> check_bracket(const std::string& plugin);
/// Brackets that are not what they are claimed to be, which must be rejected: one without Jacobi's identity,
/// one not quite skew.
std::vector<Check> check_false_brackets();
/// Equations K zdot + D = 0 that are not self-adjoint, by one entry of D, of K, and a chart that is not
/// Darboux's at the time it is used.
std::vector<Check> check_false_structures();
/// Constraints that are not what they are claimed to be: off the surface at the start, with a wrong gradient,
/// dependent, or not kept.
std::vector<Check> check_false_constraints();
/// Metriplectic systems with a symmetric bracket or an entropy that is wrong by 1e-6, or in its sign.
std::vector<Check> check_false_metriplectic();
/// Methods that are not what they are claimed to be: RK4 symplectic and K-symplectic, su-qin (105) as
/// printed.
std::vector<Check> check_false_methods();

/// Everything, or what the names select (plug-ins or "su-qin" groups); jobs run in parallel, results in fixed
/// order. `full` adds the large orders.
std::vector<Check> verify(
    const std::vector<std::string>& names, bool full,
    const std::function<void(const std::string& what, std::size_t done, std::size_t all)>& progress);

}  // namespace pfaff
