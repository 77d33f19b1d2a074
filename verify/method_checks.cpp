// All checks of one method on one system: its order, what every step has to satisfy, and each claim of the
// method.
#include <algorithm>
#include <cmath>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/claim_checks.hpp>
#include <pfaff/verify/method_on_model.hpp>
#include <pfaff/verify/rounding_of_step.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

namespace {

// Exempts a method whose coefficients are doubles from claims in quad, because such coefficients keep its
// residuals above round-off there.
void exempt_from_quad(std::vector<Check>& checks, const MethodOnModel& on) {
  std::vector<std::string> exempt{"double-is-quad-rounded", "step-jacobian"};
  for (const Claim claim : on.claims()) exempt.emplace_back(to_string(claim));
  for (const std::string& claim : exempt) {
    Check check = on.check(claim, "coefficients in quad", precision_name<Quad>());
    check.in_scope = false;
    check.reason = "the method's coefficients are in double";
    checks.push_back(std::move(check));
  }
}

// Passes a failed check whose residual is rounding: it is measured again, from starts that are moved.
template <class T, class Residual>
void excuse_rounding(Check& check, const MethodOnModel& on, const Residual& residual) {
  const auto residuals = of_moved_starts<T>(on.start(), [&](const std::vector<Real>& start) {
    MeasuredStep<T> moved = on.step_from<T>(start, on.step_size());
    return residual(moved);
  });
  if (!is_rounding(residuals, check.tolerance)) return;
  check.result = CheckResult::pass;
  check.reason = multiplied_rounding;
}

// Measures the claims of the method, but those that need a Jacobian where there is none; claims that it does
// not make are measured where their rows say so, and not judged. Claims about rounding are measured in double
// alone, and only where long runs are; ensembles of them take too long on systems of many coordinates.
template <class T>
void check_claims(std::vector<Check>& checks, MethodOnModel& on, bool long_runs) {
  for (const ClaimCheck& row : claim_checks()) {
    if (row.from_jacobian && !on.differentiable()) continue;
    constexpr int most_in_long_runs = 8;
    if (row.of_rounding &&
        (std::is_same_v<T, Quad> || !long_runs || on.model()->dimension() > most_in_long_runs))
      continue;
    const Model& model = *on.model();
    const bool shown = row.shown_on == nullptr ? in_scope(row.claim, model) : row.shown_on(model);
    if (!shown && !on.claims(row.claim)) continue;
    const ClaimRow& claim = claim_row(row.claim);
    if (row.from_jacobian && on.history()) {
      Check check = on.check(std::string(claim.name), std::string(claim.scope), precision_name<T>());
      check.in_scope = on.claims(row.claim);
      check.reason =
          "the method remembers earlier steps: its map takes several states, and a claim about the map of "
          "one state "
          "cannot be judged";
      checks.push_back(std::move(check));
      continue;
    }
    const std::string name(claim.name), scope(claim.scope);
    const Check named = on.check(name, scope, precision_name<T>());
    const auto judge = [&] {
      const double value = residual_of(row, on.step<T>());
      const double limit = largest_allowed<T>(row) * (row.from_jacobian ? on.growth_of_round_off() : 1);
      Check check = on.residual(name, scope, on.claims(row.claim), precision_name<T>(), value, limit);
      if (check.result == CheckResult::fail && row.of_rounding) {
        if (std::isnan(value))
          return not_judged(named, "a step did not converge, or truncation hides rounding");
      } else if (check.result == CheckResult::fail) {
        excuse_rounding<T>(check, on, [&](MeasuredStep<T>& step) { return residual_of(row, step); });
      }
      return check;
    };
    checks.push_back(within_budget(named, judge, row.of_rounding ? limits_of_long_runs : limits_of_check));
  }
}

// Passes failed claims whose residual is what the method's own stopping rule leaves. That is no rounding,
// which moves with every input, but it falls with the precision as rounding does, by more than any error of a
// method could.
void excuse_stopping(std::vector<Check>& checks) {
  for (Check& in_quad : checks)
    for (Check& in_double : checks) {
      if (in_quad.precision != precision_name<Quad>() || in_double.precision != precision_name<double>() ||
          in_quad.claim != in_double.claim)
        continue;
      // As much as this step multiplies roundings, which double has shown.
      const double multiplied =
          in_double.reason == multiplied_rounding ? in_double.measured / in_double.tolerance : 1;
      const double most = std::max(most_left_by_stopping, multiplied);
      const bool double_holds =
          in_double.result == CheckResult::pass || in_double.measured <= most * in_double.tolerance;
      if (!double_holds || !(in_quad.measured <= most * in_quad.tolerance)) continue;
      for (Check* const check : {&in_quad, &in_double}) {
        if (check->result != CheckResult::fail) continue;
        check->result = CheckResult::pass;
        check->reason = "what the method's own stopping rule leaves: it falls with the precision";
      }
    }
}

// Leaves failures undecided where coordinates are of very different sizes, as metres and the momenta of
// molecules are, and the method adds numbers of different units, which swamp each other at every step size.
// On other systems the same claims are judged.
void excuse_mixed_units(std::vector<Check>& checks, const MethodOnModel& on) {
  if (std::all_of(checks.begin(), checks.end(), good)) return;
  const std::string differ = sizes_that_differ(on);
  if (differ.empty() || !adds_up_units(on)) return;
  for (Check& check : checks)
    if (!good(check)) check = not_judged(std::move(check), differ + ", and the method adds them up");
}

std::vector<Check> checks_of(const MethodInstance& method, const Assignments& parameters,
                             const std::string& system, const std::shared_ptr<const Model>& model,
                             bool long_runs, bool along_runs) {
  std::optional<MethodOnModel> made;
  std::vector<Check> checks{
      within_budget(check_named(method, parameters, system, "steps", "every system", "both"),
                    [&] { return check_steps(made.emplace(method, parameters, system, model)); })};
  if (!made || !made->steps()) return checks;
  MethodOnModel& on = *made;
  const auto within = [&](const char* claim, const char* scope, const char* precision, const auto& judge) {
    return within_budget(on.check(claim, scope, precision), [&] { return judge(on); });
  };
  const char* const of_order = on.double_coefficients() ? "double" : "quad";
  auto conditions = within("order conditions", "every system", of_order, check_order_conditions);
  if (on.differentiable()) checks.push_back(within("order", "every system", of_order, check_order));
  if (conditions) checks.push_back(std::move(*conditions));
  for (Check& check : check_adaptive(on)) checks.push_back(std::move(check));
  if (on.history() && !on.double_coefficients()) {
    checks.push_back(within("steps of another motion", "methods with history", "quad", check_continuation));
    checks.push_back(within("steps of another size", "methods with history", "quad", check_changed_steps));
  }
  if (method.processed())
    checks.push_back(within("steps-in-a-row", "processed methods", "quad", check_steps_in_a_row));
  if (on.double_coefficients()) {
    exempt_from_quad(checks, on);
  } else {
    checks.push_back(within("double-is-quad-rounded", "every system", "double", check_precisions));
    if (on.differentiable() && !on.history())
      checks.push_back(within("step-jacobian", "every system", "quad", check_step_jacobian));
    check_claims<Quad>(checks, on, long_runs);
  }
  check_claims<double>(checks, on, long_runs);
  excuse_stopping(checks);
  if (along_runs)
    for (Check& check : check_along_run(on)) checks.push_back(std::move(check));
  excuse_mixed_units(checks, on);
  return checks;
}
}  // namespace

std::vector<Check> check_method(const MethodInstance& method, const Assignments& parameters,
                                const std::string& system, const std::shared_ptr<const Model>& model,
                                bool along_runs) {
  return checks_of(method, parameters, system, model, true, along_runs);
}

std::vector<Check> check_in_short_runs(const MethodInstance& method, const Assignments& parameters,
                                       const std::string& system, const std::shared_ptr<const Model>& model) {
  return checks_of(method, parameters, system, model, false, false);
}

std::vector<Check> check_method(const MethodPlugin& plugin, const Assignments& parameters,
                                const SystemPlugin& system) {
  const auto method = plugin.make(parameters);
  return check_method(*method, parameters, system.name(), motion_for(*method, system.make({})));
}

}  // namespace pfaff
