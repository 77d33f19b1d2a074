// How many steps a loop may take before it asks the budget of its thread again (core/errors/budget.hpp).
//
// A loop of cheap steps asks once for many of them, since asking costs as much as such a step; one of long
// steps asks between any two. How many there are depends on the problem alone and not on the clock, so that a
// budget ends a loop after the same step on every machine. A loop that is told to end is not in the middle of
// a step: it puts away the state that it has reached, and whoever called it lets the budget throw.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <type_traits>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/linear/vector.hpp>

namespace pfaff::detail {

/// The steps of one loop on a problem of type P. Evaluations are those that the problem has counted
/// meanwhile.
template <class P>
class AllowedSteps {
 public:
  explicit AllowedSteps(const P& problem)
      : problem_(problem), budget_(Budget::current()), paid_(counted(problem)) {}
  AllowedSteps(const AllowedSteps&) = delete;
  AllowedSteps& operator=(const AllowedSteps&) = delete;
  ~AllowedSteps() {
    if (budget_ != nullptr) (void)budget_->take(0, evaluations());
  }

  /// How many of `wanted` steps (> 0) to take before it is asked again. 0 where the loop is to end, which
  /// spend(1, 0) then says by what it throws.
  [[nodiscard]] std::int64_t next(std::int64_t wanted) {
    if (budget_ == nullptr) return wanted;
    return budget_->take(std::min(wanted, at_once()), evaluations());
  }

  /// Takes steps 0, 1, ..., count - 1 by step(k) until one does not converge or the budget ends it, and
  /// leaves in `taken` how many were taken. Converged with fewer than `count` where the budget has ended it.
  /// look() is called after each `stride` steps.
  template <class Step, class Look>
  Status repeat(std::int64_t count, std::int64_t stride, std::int64_t& taken, Step&& step, Look&& look) {
    Status status = Status::converged;
    std::int64_t k = 0, allowed = 0, looked_at = stride;
    while (k < count) {
      if (k == allowed) allowed = k + next(count - k);
      if (k == allowed) break;
      for (const std::int64_t end = std::min(allowed, looked_at); k < end; ++k) {
        status = step(k);
        if (status != Status::converged) break;
      }
      if (status != Status::converged) break;
      if (k == looked_at) look(), looked_at += stride;
    }
    taken = k;
    return status;
  }
  template <class Step>
  Status repeat(std::int64_t count, std::int64_t& taken, Step&& step) {
    return repeat(count, count, taken, step, [] {});
  }

 private:
  // A step of n components in double takes some n nanoseconds at least. Other scalars take a hundred times as
  // long, and asking is lost in a single one of their steps.
  [[nodiscard]] std::int64_t at_once() const {
    if constexpr (!std::is_same_v<typename P::Scalar, double>) {
      return 1;
    } else if constexpr (P::extent != dynamic) {
      return std::max(1, 256 / P::extent);
    } else {
      return std::max<std::int64_t>(1, 256 / static_cast<std::int64_t>(problem_.size()));
    }
  }
  static std::int64_t counted(const P& problem) {
    if constexpr (requires {
                    { problem.counters().fields } -> std::convertible_to<std::int64_t>;
                  })
      return problem.counters().fields;
    return 0;
  }
  std::int64_t evaluations() {
    const std::int64_t before = paid_;
    paid_ = counted(problem_);
    return paid_ - before;
  }

  const P& problem_;
  Budget* budget_;
  std::int64_t paid_;
};

}  // namespace pfaff::detail
