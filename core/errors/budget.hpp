// Budget: how many steps and evaluations of formulas a piece of work may take, and whether it was asked to
// stop.
//
// Whatever steps, searches or iterates for as long as it takes spends from the budget of its thread between
// any two steps. The limits are counts, so that a result does not depend on the machine. A budget that is
// made while another one is in force spends from that one too: a check within a command has its own limits
// and ends with the command. What has run out ends by an exception that nothing takes for a result.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

/// The limits of a Budget; without limits where they are not given.
struct BudgetLimits {
  static constexpr std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();
  std::int64_t steps = unlimited;
  std::int64_t evaluations = unlimited;  // of right-hand sides; one expansion in a series counts once
};

/// Thrown where a budget has run out or the work was asked to stop. An error, never a result: what was
/// reached before it is with whoever holds the state.
class BudgetSpent : public RunError {
 public:
  enum class Reason { steps, evaluations, stop };
  BudgetSpent(Reason reason, std::int64_t limit);
  [[nodiscard]] Reason reason() const { return reason_; }
  /// True where somebody asked for the end, and no limit was reached.
  [[nodiscard]] bool stopped() const { return reason_ == Reason::stop; }

 private:
  Reason reason_;
};

/// In force on its thread from its construction to its destruction. Objects of one thread end in the reverse
/// order of their beginning, as local variables do.
class Budget {
 public:
  /// `stop`, where there is one, is looked at whenever something is spent and must outlive the object.
  explicit Budget(const BudgetLimits& limits, const std::atomic<bool>* stop = nullptr);
  ~Budget();
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  /// The budget in force on this thread, the innermost one; null where there is none.
  [[nodiscard]] static Budget* current() noexcept;

  /// Takes from this budget and from those around it. Throws BudgetSpent where one of them has run out or was
  /// asked to stop.
  void spend(std::int64_t steps, std::int64_t evaluations);
  /// Takes `evaluations` and as many of `steps` (> 0) as are left, and says how many these are. 0 means that
  /// spend(1, 0) throws: loops ask in this way that have to put away their state before they end.
  [[nodiscard]] std::int64_t take(std::int64_t steps, std::int64_t evaluations) noexcept;

  /// The flag that ends this budget or one around it; null where there is none. Budgets are of one thread, so
  /// that tasks on other threads are given their own with this flag.
  [[nodiscard]] const std::atomic<bool>* stop() const noexcept;
  /// What was taken from this budget so far.
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  [[nodiscard]] std::int64_t evaluations() const { return evaluations_; }

 private:
  BudgetLimits limits_;
  const std::atomic<bool>* stop_;
  std::int64_t steps_ = 0, evaluations_ = 0;
  Budget* around_;
};

/// Spends from the budget of this thread; does nothing where there is none.
inline void spend(std::int64_t steps, std::int64_t evaluations) {
  if (Budget* const budget = Budget::current()) budget->spend(steps, evaluations);
}

}  // namespace pfaff
