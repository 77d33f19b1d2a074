// Integration: a motion, a method, a state and the time it has reached, as one object.
//
// It owns what a loop of steps needs and takes the loop from its users: steps() and to() take steps, watchers
// look at blocks of the states that go by, and the state that was reached is there whatever ended the call.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/integrator.hpp>

namespace pfaff {

template <class T>
class Integration;

/// Looks at states while they go by, a call for a whole block of them.
template <class T>
class Watcher {
 public:
  virtual ~Watcher() = default;
  /// Called by watch(), before the first step: the state is that of the start.
  virtual void start(const Integration<T>& run) = 0;
  /// Looks at the rows of a block. Where several watchers look at different steps, a block has the rows of
  /// all of them, and more where their numbers of steps are no multiples of each other; Block::row_of finds
  /// one's own. Returns block.rows, or the row with which the run is to end. The other watchers are shown the
  /// whole block all the same, and the rows behind the end once more where the run goes on.
  virtual std::size_t look(const Integration<T>& run, const Block<T>& block) = 0;
};

/// How a call of Integration::steps or Integration::to ended.
class [[nodiscard]] Outcome {
 public:
  enum class End {
    reached,  // all that was asked for
    failed,   // a step failed, see status()
    watcher,  // a watcher ended it
    asked     // the flag of stop_when() was set
  };
  Outcome(End end, Status status, std::int64_t steps, std::string where)
      : end_(end), status_(status), steps_(steps), where_(std::move(where)) {}
  [[nodiscard]] End end() const { return end_; }
  [[nodiscard]] bool reached() const { return end_ == End::reached; }
  [[nodiscard]] Status status() const { return status_; }
  /// How many steps of one size, or intervals of a method that chooses its steps, lead to the state.
  [[nodiscard]] std::int64_t steps() const { return steps_; }
  /// What ended the call and where, as a sentence without a full stop; empty where all was reached.
  [[nodiscard]] std::string message() const;
  /// Throws RunError with the message where not all was reached.
  void expect_reached() const;

 private:
  End end_;
  Status status_;
  std::int64_t steps_;
  std::string where_;
};

/// What kind of failure a status is, followed by where it happened; empty for Status::converged.
[[nodiscard]] std::string failure(Status status, const std::string& where);

/// What an Integration is made of.
template <class T>
struct Start {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const MethodInstance> method;
  std::vector<T> state;  // a number for each coordinate of the model
  T h{0};                // the step, of either sign; with a tolerance the time between the states looked at
  T t0{0};
  T tolerance{0};              // > 0: the method chooses its steps, see Tolerance
  std::vector<T> absolute{};   // absolute tolerances beside it: none, or one for each coordinate
  std::size_t block_rows = 0;  // the most states that watchers see at once; 0: chosen by their size
};

/// One integration. Times are t0 + n h, computed from the number n of steps. Of the scalars it is there for
/// StepScalars. A copy would have to copy what a method remembers, so that it can be moved alone.
template <class T>
class Integration {
 public:
  /// InputError where the method refuses the model, where the state has another size or a number that is not
  /// finite, where the step is zero or not finite, and where a tolerance is given to a method that takes
  /// fixed steps.
  explicit Integration(Start<T> start);

  [[nodiscard]] const std::shared_ptr<const Model>& model() const { return start_.model; }
  [[nodiscard]] const MethodInstance& method() const { return *start_.method; }
  [[nodiscard]] bool adaptive() const { return value_of(start_.tolerance) > Value<T>(0); }
  /// Of the state. Both belong together after every call that returns, and where a budget ends it between two
  /// steps. What a formula throws within a step of a method that chooses its steps leaves the time ahead.
  [[nodiscard]] T time() const { return adaptive() ? reached_ : time_of(taken_); }
  [[nodiscard]] T time_of(std::int64_t step) const {
    return start_.t0 + T(static_cast<double>(step)) * start_.h;
  }
  [[nodiscard]] const T& step() const { return start_.h; }
  /// The most rows of a block that watchers see.
  [[nodiscard]] std::size_t block_rows() const { return block_.capacity; }
  /// The number of the step at which the state stands, counted from t0.
  [[nodiscard]] std::int64_t steps_taken() const { return taken_; }
  /// The last finite state of those that are looked at; where nobody watches, of all between two steps, but
  /// of a method with a processor that at the beginning of the call.
  [[nodiscard]] std::span<const T> state() const { return state_; }
  [[nodiscard]] const Counters& counters() const { return stepper_->counters(); }

  /// The same method from another state, at the time reached and with the same step, or at others. Nobody
  /// watches it and it remembers nothing.
  [[nodiscard]] Integration beside(std::vector<T> state) const;
  [[nodiscard]] Integration beside(std::vector<T> state, const T& t0, const T& h) const;
  /// From here back, with steps of -h; it remembers nothing.
  [[nodiscard]] Integration reversed() const;
  /// The same integration after `step` steps, at a state that is known: times are those of this one.
  [[nodiscard]] Integration at(std::int64_t step, std::vector<T> state) const;
  /// Turns round where it is. What the method remembers stays with it, and whether it can use that for steps
  /// of -h is the method's: a leap-frog starts anew. Steps are counted anew from here.
  void turn();

  /// Shows `watcher`, which must outlive the integration, the state after every `every` steps.
  void watch(Watcher<T>& watcher, std::int64_t every = 1);
  /// Ends calls of steps() and to() between two steps once the flag is set, which must outlive the
  /// integration.
  void stop_when(const std::atomic<bool>& asked) { asked_ = &asked; }

  /// Takes `count` steps (>= 0). BudgetSpent passes where the budget of this thread ends them; state and time
  /// are then those that were reached.
  Outcome steps(std::int64_t count);
  /// Takes whole steps until `t` is reached to a billionth of a step, or passed by less than one. With a
  /// tolerance it ends at `t`, or to a billionth of an interval at the end of one. InputError for a time that
  /// lies behind.
  Outcome to(const T& t);

 private:
  struct Watching {
    Watcher<T>* watcher;
    std::int64_t every;
  };
  Outcome ended(std::int64_t begin, Outcome::End end, Status status) const;
  Status fill(std::int64_t stride, std::int64_t rows);
  Status fill_adaptive(std::int64_t rows);
  Status fill_and_look(std::int64_t stride, std::int64_t rows, bool& ends);
  bool look();
  Status advance_to(const T& t);
  Outcome to_between(const T& t, std::int64_t begin);
  template <class Loop>
  Outcome guarded(std::int64_t begin, Loop&& loop);

  Start<T> start_;
  std::vector<T> state_;
  T reached_;
  std::int64_t taken_ = 0;
  StepperPointer<T> stepper_;
  Block<T> block_;
  std::vector<Watching> watching_;
  const std::atomic<bool>* asked_ = nullptr;
};

}  // namespace pfaff
