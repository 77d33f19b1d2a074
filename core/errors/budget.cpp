#include <pfaff/core/errors/budget.hpp>

#include <algorithm>

namespace pfaff {

namespace {
// The library is loaded when the program starts, so that the address is found without a call: a step may take
// no longer than ten such calls.
[[gnu::tls_model("initial-exec")]] thread_local Budget* in_force = nullptr;

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
  evaluations_ += evaluations;
  if (stop_ != nullptr && stop_->load(std::memory_order_relaxed))
    throw BudgetSpent(BudgetSpent::Reason::stop, 0);
  if (steps > limits_.steps - steps_) throw BudgetSpent(BudgetSpent::Reason::steps, limits_.steps);
  if (evaluations_ > limits_.evaluations)
    throw BudgetSpent(BudgetSpent::Reason::evaluations, limits_.evaluations);
  if (around_ != nullptr) around_->spend(steps, evaluations);
  steps_ += steps;  // no step that was refused
}

std::int64_t Budget::take(std::int64_t steps, std::int64_t evaluations) noexcept {
  for (Budget* b = this; b != nullptr; b = b->around_) {
    b->evaluations_ += evaluations;
    const bool ended = (b->stop_ != nullptr && b->stop_->load(std::memory_order_relaxed)) ||
                       b->evaluations_ > b->limits_.evaluations;
    steps = ended ? 0 : std::clamp<std::int64_t>(b->limits_.steps - b->steps_, 0, steps);
  }
  for (Budget* b = this; b != nullptr; b = b->around_) b->steps_ += steps;
  return steps;
}

const std::atomic<bool>* Budget::stop() const noexcept {
  for (const Budget* b = this; b != nullptr; b = b->around_)
    if (b->stop_ != nullptr) return b->stop_;
  return nullptr;
}

}  // namespace pfaff
