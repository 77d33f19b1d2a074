// Checks: every claim of every plug-in is measured against its tolerance, and claims known to be false
// (controls) must be found false by the same measure.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/bench/studies/options.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/motion.hpp>

namespace pfaff {

struct Region;  // residuals.hpp

/// The result of a check.
/// - pass: the claim holds.
/// - fail: the claim does not hold.
/// - measured: the claim is not made here or out of its scope; the number is only shown.
/// - rejected: the check is a control, a claim known to be false, and was found false, as it must be.
/// - skipped: it was not measured, for the reason given. Where that begins with "not judged", the budget of
///   the check was spent (check_budget.hpp), which is neither a pass nor a failure.
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

/// True where a check is as it should be: a claim in scope passes and a control is rejected. Out of scope,
/// any measured value is good. A skipped check is good when it gives its reason.
bool good(const Check& check);

/// True where a check looks at a system or a bracket itself, whatever methods do with it.
bool own_identity(const Check& check);

/// What stands in the place of checks of a system whose formulas are all needed to make its motion: each is
/// what it is, and none can contradict another. Such a system is not wrong, and nothing is left to be tried.
Check nothing_stated(const std::string& system);
/// True of that.
bool states_nothing(const Check& check);

nlohmann::json to_json(const Check& check);

/// The plug-in with its parameters, and the system where there is one: "gauss stages=3 on kepler".
std::string place_of(const Check& check);

/// A state of a system at which claims are measured, for use with `generic_time_of`: the initial state, moved
/// off any symmetry that could hide an error, and moved back onto the constraints where there are any.
/// InputError when the model has no initial state, or when no such point was found.
std::vector<Real> generic_state(const Model& model);
/// The time at which claims are measured: 0.37 in units of the time in which the motion from the initial
/// state changes by its own size (own_time), so that whoever writes a driving force chooses its unit of time
/// freely. In plain units of time for a model that moves by a formulation only.
Real generic_time_of(const Model& model);
/// The order of a method, measured from its errors in quad against Taylor series. The error of a single step
/// is measured while the step is halved, forwards and backwards, of which the lower order counts; the slope
/// is log2 of the ratio of successive errors, minus one. Errors above a tenth of the state are left out.
/// Halving ends when, of four slopes or more, the last two differ by less than 0.01 and the two before by
/// less than 0.02; where round-off comes first, the order is not measurable there. Methods that need
/// constraints are measured by their errors at the end of a fixed interval instead, without the minus one.
/// The reason is that momenta of central differences do not accumulate their errors: over many steps they are
/// as accurate as the positions, but after one step they are not. So are methods with history, over a longer
/// interval, because their first steps are those of another method, which makes the starting values. Methods
/// whose coefficients are doubles are measured in quad too, down to the error of their coefficients.
struct MeasuredOrder {
  double slope = 0;
  bool settled = false;
  bool exact = false;           // the longest step has an error of round-off, and the slopes do not settle
  bool backwards = false;       // measured with h < 0
  bool forwards_alone = false;  // steps of h < 0 show none
  double moving = 0;            // by how much the last slopes differ, of three or more that have not settled
  std::string reason;           // why it has not settled
};
MeasuredOrder measure_order(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                            bool history = false);
/// The order measured as the step falls by factors of ten to 1e-10; with history, from one halving over a
/// long interval. A small error of a coefficient dominates the error of so small a step, and so lowers the
/// slope.
double order_at_small_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model,
                            bool history);

/// Checks of one method with given parameters on one system, in double and quad.
std::vector<Check> check_method(const MethodPlugin& plugin, const Assignments& parameters,
                                const SystemPlugin& system);
/// The same for a method and a model that fit each other, listed under the name `system`; along runs, too,
/// where that is asked for.
std::vector<Check> check_method(const MethodInstance& method, const Assignments& parameters,
                                const std::string& system, const std::shared_ptr<const Model>& model,
                                bool along_runs = true);
/// The method with one coefficient changed by 1e-6 must lose its order or its structure.
std::vector<Check> check_changed_coefficient(const MethodInstance& method, const Assignments& parameters,
                                             const SystemPlugin& system);
/// The order conditions of the method's own coefficients, by trees, Lie words or whatever theory is known for
/// it (integrators/order_conditions), with a control for each coefficient: the same conditions with 1e-9
/// added to it and taken from another one, so that the condition of order 1 holds; one of order 2 or more
/// must be violated. Empty where no theory is known.
std::vector<Check> check_coefficients(const MethodPlugin& plugin, const Assignments& parameters);
/// Checks the structure, chart, overrides, invariants and exact solution of a system with these parameters.
std::vector<Check> check_system(const SystemPlugin& system, const Assignments& parameters = {});
/// The same of a model, listed under the name.
std::vector<Check> check_system(const std::string& name, const std::shared_ptr<const Model>& model,
                                const Assignments& parameters);
/// Checks of a system with constraints: the initial state is on them, they are second class there, the
/// author's own evaluator computes what is derived from the formulas, and Dirac's formulation keeps the
/// constraints, off their surface too.
std::vector<Check> check_constraints(const std::string& name, const std::shared_ptr<const Model>& model);
/// Checks of a metriplectic system: its symmetric bracket, the degeneracy conditions, and the signs of the
/// rates of energy and entropy.
std::vector<Check> check_metriplectic(const std::string& name, const Model& model);
/// Checks of a motion that states a reversal rho, at states of a region: rho is an involution, and it turns
/// the field round, d rho X = -X o rho.
std::vector<Check> check_reversal(const std::string& name, const Model& motion, const Region& region);
/// Checks of a system with parts that are solved exactly, at a state: the flow of each part is a group and
/// keeps the structure of the system, and the derivatives of the flows at time zero add up to its field.
std::vector<Check> check_flows(const std::string& name, const std::shared_ptr<const Model>& model,
                               const std::vector<Real>& centre);
/// Symmetry and Jacobi identity of a bracket with these parameters.
std::vector<Check> check_bracket(const BracketPlugin& plugin, const Assignments& parameters);
/// The parameters that a bracket is verified with: the defaults, and each choice it offers.
std::vector<Assignments> instances_of(const BracketPlugin& plugin);
/// What a measure gives where its answers are known, and whether it sees the faults that it states.
std::vector<Check> check_measure(const MeasurePlugin& plugin);
/// Controls: one bracket without Jacobi's identity and one that is not quite skew, both of which must be
/// rejected.
std::vector<Check> check_false_brackets();
/// Controls: equations K zdot + D = 0 that are not self-adjoint because one entry of D or of K is changed,
/// and a chart that is not Darboux's at the time it is used.
std::vector<Check> check_false_structures();
/// Controls: constraints that the initial state is off, with a wrong gradient, dependent on each other, or
/// not kept by the motion.
std::vector<Check> check_false_constraints();
/// Controls: metriplectic systems whose symmetric bracket or entropy is wrong by 1e-6 or in its sign.
std::vector<Check> check_false_metriplectic();
/// Controls: reversals that are wrong by 1e-6 and so no involution, or that do not turn the field round.
std::vector<Check> check_false_reversals();
/// Controls: flows that are no group, do not add up to the field, or do not keep the structure, by 1e-6.
std::vector<Check> check_false_flows();
/// The control of processed methods: one whose processor is wrong by 1e-6 where it is taken back.
std::vector<Check> check_false_processors();
/// Controls: a method with a false claim of every kind, and the scheme su-qin (105) as printed, which has a
/// misprint.
std::vector<Check> check_false_methods();

/// Thrown where somebody asked a verification to end: what was checked by then.
class VerificationInterrupted : public RunError {
 public:
  VerificationInterrupted(const std::string& message, std::vector<Check> made)
      : RunError(message), checks(std::move(made)) {}
  std::vector<Check> checks;
};

/// Runs the checks. They run in parallel and their results come in a fixed order. InputError for an unknown
/// name, and for parameters where not exactly one plug-in is named. VerificationInterrupted.
std::vector<Check> verify(
    const VerificationSettings& settings,
    const std::function<void(const std::string& what, std::size_t done, std::size_t all)>& progress = {});

/// A method that need not be registered, and the parameters that it was made with.
struct MethodToVerify {
  std::shared_ptr<const MethodInstance> method;
  Assignments parameters{};
};
/// The same of objects. Methods are verified on the models `on`, where there are any, and else on random
/// systems and on every registered system that they fit; systems are verified themselves. InputError for a
/// method that does not fit a model of `on`.
std::vector<Check> verify(const std::vector<MethodToVerify>& methods,
                          const std::vector<std::shared_ptr<const Model>>& systems,
                          const std::vector<std::shared_ptr<const Model>>& on);

/// What checks come to.
struct Verdict {
  bool ok = false;       // all is as it should be, and something was checked or nothing is stated
  bool checked = false;  // something was
  std::string line;      // in a sentence: what holds, what was not judged and, first, whether all is well
};
Verdict verdict_of(const std::vector<Check>& checks);

}  // namespace pfaff
