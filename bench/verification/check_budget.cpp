#include <pfaff/bench/verification/check_budget.hpp>

namespace pfaff {

namespace {
constexpr const char* unjudged = "not judged: ";
}  // namespace

bool ran_out(const Check& check) {
  return check.result == CheckResult::skipped && check.reason.starts_with(unjudged);
}

Check not_judged(Check check, const BudgetSpent& spent) {
  if (spent.stopped()) throw BudgetSpent(spent);
  check.in_scope = false;
  check.result = CheckResult::skipped;
  check.reason = unjudged + std::string(spent.what());
  return check;
}

}  // namespace pfaff
