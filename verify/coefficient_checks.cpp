// The order conditions of a method's own coefficients, evaluated exactly and without a step: a coefficient
// that is wrong by 1e-9 shows here whatever the systems are.
//
// A coefficient that is changed alone breaks the sum in the conditions of order 1 that it is a term of, and
// that hides whether the conditions of higher orders are evaluated at all. A control takes from another term
// of that sum what it adds to one, and only conditions of order 2 and more may reject it.
#include <pfaff/integrators/order_conditions/order_condition.hpp>
#include <pfaff/verify/check.hpp>

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

// The check of the conditions of order `lowest` and more.
Check judged(const OrderTheory& theory, const std::vector<Quad>& coefficients, int lowest) {
  Check check;
  check.scope = "its coefficients, by " + theory.kind;
  check.precision = "quad";
  check.tolerance = static_cast<double>(theory.precision);
  std::vector<OrderCondition> conditions = theory.conditions(coefficients);
  std::erase_if(conditions, [&](const OrderCondition& condition) { return condition.order < lowest; });
  const OrderCondition* worst = worst_of(conditions);
  if (worst == nullptr) {
    check.result = lowest == 1 ? CheckResult::fail : CheckResult::pass;
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

// The other terms of the sum that a coefficient is in, from the next one on and around.
std::vector<std::size_t> partners_of(const OrderTheory& theory, std::size_t coefficient) {
  const std::size_t count = theory.coefficients.size();
  const auto sum = [&](std::size_t k) { return theory.sums.empty() ? 0 : theory.sums[k]; };
  std::vector<std::size_t> partners;
  if (sum(coefficient) == OrderTheory::in_no_sum) return partners;
  for (std::size_t step = 1; step < count; ++step) {
    const std::size_t other = (coefficient + step) % count;
    if (sum(other) == sum(coefficient)) partners.push_back(other);
  }
  return partners;
}

// The control that changes a coefficient. Low orders may have no other conditions than those of the sums;
// neither need a sum of one term, such as the kick of a drift, a kick and a drift, enter any others: there
// the coefficient is changed alone, and every condition counts.
Check control_of(const OrderTheory& theory, std::size_t coefficient) {
  const std::string name = "conditions with coefficient " + std::to_string(coefficient);
  const Quad amount(1e-9);
  std::vector<Quad> changed = theory.coefficients;
  changed[coefficient] += amount;
  const std::vector<std::size_t> partners = partners_of(theory, coefficient);
  const bool in_no_sum = !theory.sums.empty() && theory.sums[coefficient] == OrderTheory::in_no_sum;
  Check control;
  if (theory.order < theory.next_order || partners.empty()) {
    control = judged(theory, changed, in_no_sum ? 2 : 1);
    control.claim = name + " changed by 1e-9";
  } else {
    // Some shifts leave the method what it is, such as one between drifts with a kick of 0 between them.
    for (const std::size_t partner : partners) {
      std::vector<Quad> shifted = changed;
      shifted[partner] -= amount;
      control = judged(theory, shifted, 2);
      control.claim = name + " changed by 1e-9 and coefficient " + std::to_string(partner) + " by -1e-9";
      if (control.result == CheckResult::fail) break;
    }
  }
  control.control = true;
  control.result = control.result == CheckResult::fail ? CheckResult::rejected : CheckResult::pass;
  return control;
}

}  // namespace

std::vector<Check> check_coefficients(const MethodPlugin& plugin, const Assignments& parameters) {
  const auto theory = order_theory(plugin.name(), parameters);
  if (!theory) return {};
  std::vector<Check> checks{judged(*theory, theory->coefficients, 1)};
  checks.front().claim = "order " + std::to_string(theory->order) + " by its coefficients";
  for (std::size_t k = 0; k < theory->coefficients.size(); ++k) checks.push_back(control_of(*theory, k));
  for (Check& check : checks) {
    check.plugin = plugin.name();
    check.parameters = parameters;
  }
  return checks;
}

}  // namespace pfaff
