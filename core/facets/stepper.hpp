// One integration of one model by one method, behind an interface that is virtual once for many steps.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/tolerance.hpp>

namespace pfaff {

/// One integration of one model. The caller keeps the state, the stepper the history of past steps.
template <class T>
class Stepper {
 public:
  virtual ~Stepper() = default;
  /// Steps first … first + count - 1 of size h (of either sign) from t0; see pfaff::advance. Where the state
  /// that they reach is not finite, the status is non_finite, z is as it was before the call, `completed` is
  /// 0, and the history is dropped: which of several steps left the range of numbers is known to whoever
  /// takes them one by one. What a step throws leaves z as it was before the call and `completed` 0, and
  /// drops the history.
  virtual Status advance(const T& t0, std::int64_t first, const T& h, std::int64_t count, std::span<T> z,
                         std::int64_t& completed) = 0;
  /// Fills rows 0 … rows - 1 (at most block.capacity) of a block whose first, stride, t0 and h are set: row 0
  /// is the state `stride` steps after z, and steps have the numbers block.first - block.stride, …. The bits
  /// are those of advance() called for one row after the other. block.rows says how many rows were filled,
  /// all of them finite; z is the state after `completed` steps, which a step that fails and a budget that
  /// ends leave between two rows. Where a state is not finite, z is that of the row before, the status is
  /// non_finite and the history is dropped, as it is where a step throws: the rows before it stay, and z is
  /// the state of the last.
  virtual Status fill(Block<T>& block, std::size_t rows, std::span<T> z, std::int64_t& completed) = 0;
  /// From t to `end` with steps of the method's choosing at `tolerance`, of which a number is the relative
  /// part; t and z are left where it got to, also where BudgetSpent is thrown between two steps. Where the
  /// state there is not finite, the status is non_finite, and t, z and the counted steps are as they were, as
  /// they are where a step throws.
  /// InputError for a start at rest in zero without absolute tolerances, and of duals: what a chosen step
  /// depends on has no derivatives.
  virtual Status advance_to(T& t, const T& end, const Tolerance<T>& tolerance, std::span<T> z) = 0;
  /// Drops history and compensation: the next step depends on its state alone.
  virtual void forget() = 0;
  [[nodiscard]] virtual const Counters& counters() const = 0;
};

template <class T>
using StepperPointer = std::unique_ptr<Stepper<T>>;

namespace detail {

/// The problem, its state and the method's workspace are members, so that a call steps without looking for
/// any.
template <class M, class P>
class SteppingOn final : public Stepper<Scalar<P>> {
 public:
  using T = Scalar<P>;
  SteppingOn(const M& method, std::shared_ptr<const Model> model)
      : method_(method),
        problem_(std::move(model)),
        state_(problem_.make_state()),
        work_(std::make_unique<Work<M, P>>(method_, problem_)) {}

  Status advance(const T& t0, std::int64_t first, const T& h, std::int64_t count, std::span<T> z,
                 std::int64_t& completed) override {
    std::copy(z.begin(), z.end(), state_.begin());
    const Status status = loop(t0, first, h, 1, count, nullptr, completed);
    if (!finite()) {
      completed = 0;
      return left_as_it_was();
    }
    std::copy(state_.begin(), state_.end(), z.begin());
    problem_.counters().steps += completed;
    if (status == Status::converged && completed < count) spend(1, 0);
    return status;
  }

  Status fill(Block<T>& block, std::size_t rows, std::span<T> z, std::int64_t& completed) override {
    block.rows = 0;
    block.times.clear();
    std::copy(z.begin(), z.end(), state_.begin());
    Status status = Status::converged;
    try {
      status = loop(block.t0, block.first - block.stride, block.h, static_cast<std::int64_t>(rows),
                    block.stride, &block, completed);
    } catch (...) {
      ends_with_rows(block, z, completed);
      throw;
    }
    if (block.states.first_not_finite(block.rows) < block.rows || !finite()) {
      ends_with_rows(block, z, completed);
      return left_as_it_was();
    }
    block.states.fill_behind(block.rows);
    std::copy(state_.begin(), state_.end(), z.begin());
    problem_.counters().steps += completed;
    if (status == Status::converged && block.rows < rows) spend(1, 0);
    return status;
  }

  Status advance_to(T& t, const T& end, const Tolerance<T>& tolerance, std::span<T> z) override {
    if constexpr (std::is_same_v<T, Value<T>> &&
                  requires { method_.advance_to(problem_, t, end, tolerance, state_, *work_); }) {
      std::copy(z.begin(), z.end(), state_.begin());
      T reached = t;
      const auto steps = problem_.counters().steps;
      const auto left = [&] {
        problem_.counters().steps = steps;
        return left_as_it_was();
      };
      Status status = Status::converged;
      try {
        status = method_.advance_to(problem_, reached, end, tolerance, state_, *work_);
      } catch (...) {
        (void)left();
        throw;
      }
      if (!finite()) return left();
      t = reached;
      std::copy(state_.begin(), state_.end(), z.begin());
      if (status == Status::converged && t != end) spend(1, 0);
      return status;
    } else {
      (void)t, (void)end, (void)tolerance, (void)z;
      throw InputError("this integrator takes fixed steps only; give --step");
    }
  }

  void forget() override { work_ = std::make_unique<Work<M, P>>(method_, problem_); }
  [[nodiscard]] const Counters& counters() const override { return problem_.counters(); }

 private:
  [[nodiscard]] bool finite() const {
    for (const T& x : state_)
      if (!isfinite(value_of(x))) return false;
    return true;
  }
  // One loop for both calls, since every method is compiled with it for several sizes and scalars. What a
  // method remembers of a step that throws belongs to no state.
  [[gnu::noinline]] Status loop(const T& t0, std::int64_t first, const T& h, std::int64_t rows,
                                std::int64_t stride, Block<T>* block, std::int64_t& completed) {
    try {
      return advance_as_allowed(method_, problem_, t0, first, h, rows, stride, block, state_, *work_,
                                completed);
    } catch (...) {
      forget();
      throw;
    }
  }
  // Of a call that did not come to its end the finite rows count, and z is the last of them.
  void ends_with_rows(Block<T>& block, std::span<T> z, std::int64_t& completed) {
    block.rows = block.states.first_not_finite(block.rows);
    block.states.fill_behind(block.rows);
    if (block.rows > 0) block.states.get(block.rows - 1, z);
    completed = static_cast<std::int64_t>(block.rows) * block.stride;
    problem_.counters().steps += completed;
  }
  // Explicit methods do not look at what they make, so that their history is no more finite than the state.
  Status left_as_it_was() {
    forget();
    return Status::non_finite;
  }

  M method_;
  P problem_;
  State<P> state_;
  std::unique_ptr<Work<M, P>> work_;
};

}  // namespace detail
}  // namespace pfaff
