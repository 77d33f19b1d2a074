// Integration: a motion, a method, a state and the time it has reached, as one object.
//
// It owns what a loop of steps needs and takes the loop from its users: steps() and to() take steps, watchers
// look at blocks of the states that go by, and the state that was reached is there whatever ended the call.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <pfaff/core/facets/block.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/runs/outcome.hpp>
#include <pfaff/runs/start.hpp>

namespace pfaff {

template <class T>
class Integration;

/// Looks at states while they go by, a call for a whole block of them. A block that it is shown has the
/// states after each of its numbers of steps and no others, whoever else watches and however calls and blocks
/// are cut.
template <class T>
class Watcher {
 public:
  virtual ~Watcher() = default;
  /// Called by watch(), before the first step: the state is that of the start.
  virtual void start(const Integration<T>& run) = 0;
  /// The row with which the run is to end; block.rows where it may go on. All watchers are asked before any
  /// of them looks, and one of them may end the run at a row before: what is seen here is not to be kept.
  virtual std::size_t end(const Integration<T>& /*run*/, const Block<T>& block) { return block.rows; }
  /// Looks at the rows of a block, none of which lies behind the end of the run.
  virtual void look(const Integration<T>& run, const Block<T>& block) = 0;
};

/// One integration. Times are t0 + n h, computed from the number n of steps. Of the scalars it is there for
/// StepScalars. A copy would have to copy what a method remembers, so that it can be moved alone.
template <class T>
class Integration {
 public:
  /// InputError where there is no model or no method, where the method refuses the model, where the state has
  /// another size or a number that is not finite, where the step is zero or not finite, for tolerances out of
  /// range, and where one is given to a method that takes fixed steps.
  explicit Integration(Start<T> start);

  [[nodiscard]] const std::shared_ptr<const Model>& model() const { return start_.model; }
  [[nodiscard]] const MethodInstance& method() const { return *start_.method; }
  [[nodiscard]] bool adaptive() const { return value_of(start_.tolerance) > Value<T>(0); }
  /// Of the state. Both belong together however a call ends.
  [[nodiscard]] T time() const { return adaptive() ? reached_ : time_of(taken_); }
  [[nodiscard]] T time_of(std::int64_t step) const {
    return start_.t0 + T(static_cast<double>(step)) * start_.h;
  }
  [[nodiscard]] const T& step() const { return start_.h; }
  /// The most rows of a block that watchers see.
  [[nodiscard]] std::size_t block_rows() const { return block_.capacity; }
  /// The number of the step at which the state stands, counted from t0.
  [[nodiscard]] std::int64_t steps_taken() const { return taken_; }
  /// The state that was reached: after a step that failed the last finite one. Where steps were taken several
  /// at a time, since they are not looked at, those up to the failure are taken again one by one, and a
  /// method that remembers steps begins to do so anew.
  [[nodiscard]] std::span<const T> state() const { return state_; }
  [[nodiscard]] const Counters& counters() const { return stepper_->counters(); }

  /// The same method from another state, at the time reached and with the same step, or at others. Nobody
  /// watches it and it remembers nothing.
  [[nodiscard]] Integration beside(std::vector<T> state) const;
  [[nodiscard]] Integration beside(std::vector<T> state, const T& t0, const T& h) const;
  /// The same from here with derivatives: component i of the state has in its direction k the derivative with
  /// respect to component first + k, for as many of them as there are directions. Nobody watches it and it
  /// remembers nothing. It is there for integrations in double and in quad.
  template <class Of = T>
  [[nodiscard]] Integration<StepDual<Of>> differentiated(std::size_t first = 0) const;
  /// From here back, with steps of -h; it remembers nothing.
  [[nodiscard]] Integration reversed() const;
  /// The same integration after `step` steps, at a state that is known: times are those of this one.
  [[nodiscard]] Integration at(std::int64_t step, std::vector<T> state) const;
  /// Turns round where it is. What the method remembers stays with it, and whether it can use that for steps
  /// of -h is the method's: a leap-frog starts anew. Steps are counted anew from here.
  void turn();
  /// Goes on from another state, at another time and with another step; steps are counted from there. What
  /// the method remembers stays with it, which is how methods with a past are led back.
  void go_on_from(std::vector<T> state, const T& t0, const T& h);
  /// What the method remembers is forgotten: the next step is the one that a new integration takes from here.
  void forget() { stepper_->forget(); }

  /// Shows `watcher`, which must outlive the integration unless unwatch() is called before, the states after
  /// each `every` steps, counted from t0.
  void watch(Watcher<T>& watcher, std::int64_t every = 1);
  /// From now on `watcher` is asked and shown nothing, however often it watches; nothing happens where it
  /// does not. It may be called from within a call of a watcher.
  void unwatch(const Watcher<T>& watcher);
  /// Ends calls of steps() and to() between two steps once the flag is set, which must outlive the
  /// integration.
  void stop_when(const std::atomic<bool>& asked) { asked_ = &asked; }

  /// Takes `count` steps (>= 0). BudgetSpent, and what a step throws, pass; state and time are then those
  /// that were reached. Where a watcher ends the run at a state before, the call ends with that.
  Outcome steps(std::int64_t count);
  /// Takes whole steps until `t` is reached, or passed by less than one. With a tolerance it ends at `t`, or
  /// where that is the end of an interval, there. Times are compared to a billionth of a step and to what
  /// round-off of the times makes of it. InputError for a time that lies behind by a step or more, with a
  /// tolerance for all that lie behind; where the step is 0, none does.
  Outcome to(const T& t);

 private:
  struct Watching {
    Watcher<T>* watcher;  // null once it does not watch any more
    std::int64_t every;
    std::unique_ptr<Block<T>> thinned{};  // where it looks at fewer steps than a block has
    Block<T>* shown = nullptr;            // what it sees of the block
  };
  Outcome ended(std::int64_t begin, Outcome::End end, Status status) const;
  Status fill(std::int64_t stride, std::int64_t rows);
  Status fill_adaptive(std::int64_t rows);
  Status fill_and_look(std::int64_t stride, std::int64_t rows, bool& ends);
  void up_to_the_failure(std::int64_t steps);
  void thin(Watching& watching);
  void close_up();
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
