#include <pfaff/bench/verification/check_budget.hpp>

namespace pfaff {

namespace {
constexpr const char* unjudged = "not judged: ";

Check without_a_judgement(Check check, const std::string& why) {
  check.in_scope = false;
  check.result = CheckResult::skipped;
  check.reason = unjudged + why;
  return check;
}
}  // namespace

bool ran_out(const Check& check) {
  return check.result == CheckResult::skipped && check.reason.starts_with(unjudged);
}

Check not_judged(Check check, const BudgetSpent& spent) {
  if (spent.stopped()) throw BudgetSpent(spent);
  return without_a_judgement(std::move(check), spent.what());
}

Check not_judged(Check check, const SolutionEnds& ends) {
  return without_a_judgement(std::move(check), ends.what());
}

}  // namespace pfaff
