#include <pfaff/verify/check_budget.hpp>

namespace pfaff {

namespace {
constexpr const char* words = "not judged: ";
}  // namespace

std::int64_t short_flow(const Model& model, const Quad& t, const Quad& elapsed, std::vector<Quad>& z) {
  constexpr std::int64_t steps = 2000;
  const Budget budget({.steps = steps});
  try {
    return taylor_flow(model, t, elapsed, z);
  } catch (const BudgetSpent& spent) {
    if (spent.stopped() || budget.steps() < steps) throw;
    throw SolutionEnds(t, std::to_string(steps) + " Taylor steps lead no further");
  }
}

bool unjudged(const Check& check) {
  return check.result == CheckResult::skipped && check.reason.starts_with(words);
}

Check not_judged(Check check, const std::string& why) {
  check.in_scope = false;
  check.result = CheckResult::skipped;
  check.reason = words + why;
  return check;
}

Check not_judged(Check check, const BudgetSpent& spent) {
  if (spent.stopped()) throw BudgetSpent(spent);
  return not_judged(std::move(check), std::string(spent.what()));
}

Check not_judged(Check check, const SolutionEnds& ends) {
  return not_judged(std::move(check), std::string(ends.what()));
}

Check not_judged_on_wrong(Check check, const std::string& system) {
  return not_judged(std::move(check), system + " is itself not what it states");
}

}  // namespace pfaff
