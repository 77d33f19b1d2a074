#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

namespace {
thread_local Budget* in_force = nullptr;

std::string words(BudgetSpent::Reason reason, std::int64_t limit) {
  switch (reason) {
    case BudgetSpent::Reason::steps:
      return "the budget of " + std::to_string(limit) + " steps has run out";
    case BudgetSpent::Reason::evaluations:
      return "the budget of " + std::to_string(limit) + " evaluations has run out";
    case BudgetSpent::Reason::stop:
      break;
  }
  return "it was asked to stop";
}
}  // namespace

BudgetSpent::BudgetSpent(Reason reason, std::int64_t limit)
    : RunError(words(reason, limit)), reason_(reason) {}

Budget::Budget(const BudgetLimits& limits, const std::atomic<bool>* stop)
    : limits_(limits), stop_(stop), around_(in_force) {
  in_force = this;
}

Budget::~Budget() { in_force = around_; }

Budget* Budget::current() noexcept { return in_force; }

void Budget::spend(std::int64_t steps, std::int64_t evaluations) {
  steps_ += steps;
  evaluations_ += evaluations;
  if (stop_ != nullptr && stop_->load(std::memory_order_relaxed))
    throw BudgetSpent(BudgetSpent::Reason::stop, 0);
  if (steps_ > limits_.steps) throw BudgetSpent(BudgetSpent::Reason::steps, limits_.steps);
  if (evaluations_ > limits_.evaluations)
    throw BudgetSpent(BudgetSpent::Reason::evaluations, limits_.evaluations);
  if (around_ != nullptr) around_->spend(steps, evaluations);
}

}  // namespace pfaff
