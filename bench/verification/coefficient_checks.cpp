// The order conditions of a method's own coefficients, evaluated exactly and without a step: a coefficient
// that is wrong by 1e-9 shows here whatever the systems are.
#include <pfaff/bench/verification/check.hpp>
#include <pfaff/integrators/order_conditions/order_condition.hpp>

namespace pfaff {

namespace {

// The condition with the largest residual, one that is no number before all others; null where there are
// none.
const OrderCondition* worst_of(const std::vector<OrderCondition>& conditions) {
  const OrderCondition* worst = nullptr;
  for (const OrderCondition& condition : conditions) {
    const Quad residual = relative_residual(condition);
    const bool no_number = !(residual == residual);
    if (worst == nullptr || no_number || residual > relative_residual(*worst)) worst = &condition;
  }
  return worst;
}

Check judged(const OrderTheory& theory, const std::vector<Quad>& coefficients) {
  Check check;
  check.scope = "its coefficients, by " + theory.kind;
  check.precision = "quad";
  check.tolerance = static_cast<double>(theory.precision);
  const std::vector<OrderCondition> conditions = theory.conditions(coefficients);
  const OrderCondition* worst = worst_of(conditions);
  if (worst == nullptr) {
    check.result = CheckResult::fail;
    check.reason = "there are no conditions";
    return check;
  }
  check.measured = static_cast<double>(relative_residual(*worst));
  check.result = check.measured <= check.tolerance ? CheckResult::pass : CheckResult::fail;
  if (check.result == CheckResult::fail)
    check.reason = worst->name + ", a condition of order " + std::to_string(worst->order) + ", is off by " +
                   to_scientific(worst->residual, 3);
  return check;
}

}  // namespace

std::vector<Check> check_coefficients(const MethodPlugin& plugin, const Assignments& parameters) {
  const auto theory = order_theory(plugin.name(), parameters);
  if (!theory) return {};
  std::vector<Check> checks{judged(*theory, theory->coefficients)};
  checks.front().claim = "order " + std::to_string(theory->order) + " by its coefficients";
  for (std::size_t k = 0; k < theory->coefficients.size(); ++k) {
    std::vector<Quad> changed = theory->coefficients;
    changed[k] += Quad(1e-9);
    Check control = judged(*theory, changed);
    control.claim = "conditions with coefficient " + std::to_string(k) + " changed by 1e-9";
    control.control = true;
    control.result = control.result == CheckResult::fail ? CheckResult::rejected : CheckResult::pass;
    checks.push_back(std::move(control));
  }
  for (Check& check : checks) {
    check.plugin = plugin.name();
    check.parameters = parameters;
  }
  return checks;
}

}  // namespace pfaff
