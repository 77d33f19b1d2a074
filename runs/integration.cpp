#include <pfaff/runs/integration.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

template <class T>
Integration<T>::Integration(Start<T> start)
    : start_(checked(std::move(start))),
      state_(start_.state),
      reached_(start_.t0),
      stepper_(start_.method->stepper(start_.model, T())),
      block_(state_.size(), start_.block_rows) {}

template <class T>
Integration<T> Integration<T>::beside(std::vector<T> state) const {
  return beside(std::move(state), time(), start_.h);
}

template <class T>
Integration<T> Integration<T>::beside(std::vector<T> state, const T& t0, const T& h) const {
  Start<T> start = start_;
  start.t0 = t0, start.h = h;
  start.state = std::move(state);
  return Integration(std::move(start));
}

template <class T>
template <class Of>
Integration<StepDual<Of>> Integration<T>::differentiated(std::size_t first) const {
  Start<StepDual<Of>> start{start_.model, start_.method, {state_.begin(), state_.end()},
                            start_.h,     time(),        start_.tolerance};
  start.absolute.assign(start_.absolute.begin(), start_.absolute.end());
  start.tolerance_forgets = start_.tolerance_forgets;
  for (std::size_t k = 0; k < step_directions && first + k < state_.size(); ++k)
    start.state[first + k].derivative[k] = T(1);
  return Integration<StepDual<Of>>(std::move(start));
}

template <class T>
Integration<T> Integration<T>::reversed() const {
  return beside(state_, time(), -start_.h);
}

template <class T>
Integration<T> Integration<T>::at(std::int64_t step, std::vector<T> state) const {
  Integration run = beside(std::move(state), start_.t0, start_.h);
  run.taken_ = step;
  run.reached_ = time_of(step);
  return run;
}

template <class T>
void Integration<T>::turn() {
  go_on_from(state_, time(), -start_.h);
}

template <class T>
void Integration<T>::go_on_from(std::vector<T> state, const T& t0, const T& h) {
  check_place(*start_.model, state, h, t0, adaptive());
  start_.state = std::move(state), start_.t0 = t0, start_.h = h;
  state_ = start_.state;
  reached_ = start_.t0;
  taken_ = 0;
}

template <class T>
void Integration<T>::watch(Watcher<T>& watcher, std::int64_t every) {
  if (every <= 0) throw InputError("watch: expected a whole number > 0 of steps between two looks");
  if (adaptive() && value_of(start_.h) == Value<T>(0))
    throw InputError("step: expected the time between two looks beside the tolerance, got 0");
  watcher.start(*this);  // one that throws does not watch
  watching_.push_back({.watcher = &watcher, .every = every});
}

// Watchers that are asked and shown a block stay where they are in the list until that is done.
template <class T>
void Integration<T>::unwatch(const Watcher<T>& watcher) {
  for (Watching& w : watching_)
    if (w.watcher == &watcher) w.watcher = nullptr;
}

// Leaves out those who do not watch any more.
template <class T>
void Integration<T>::close_up() {
  std::erase_if(watching_, [](const Watching& w) { return w.watcher == nullptr; });
}

template <class T>
Outcome Integration<T>::ended(std::int64_t begin, Outcome::End end, Status status) const {
  // Of steps that were chosen, those are counted that were taken, and not the intervals between two looks.
  const std::int64_t step = adaptive() ? counters().steps : taken_;
  const std::string where = end == Outcome::End::reached ? "" : place_of(Quad(value_of(time())), step);
  return {end, status, taken_ - begin, where, adaptive()};
}

// The outcome of a loop that began at step `begin`. Where the flag is set, the budget of this call ends it
// between two steps; other budgets pass on.
template <class T>
template <class Loop>
Outcome Integration<T>::guarded(std::int64_t begin, Loop&& loop) {
  if (asked_ == nullptr) return loop();
  const Budget budget(BudgetLimits{}, asked_);
  try {
    return loop();
  } catch (const BudgetSpent& spent) {
    if (!spent.stopped() || !asked_->load()) throw;
    return ended(begin, Outcome::End::asked, Status::converged);
  }
}

namespace {
// How many steps lie from `step`, which may be negative, to the next multiple of `every`.
std::int64_t lattice_behind(std::int64_t step, std::int64_t every) {
  const std::int64_t rest = step % every;
  return rest == 0 ? 0 : rest < 0 ? -rest : every - rest;
}
}  // namespace

// Takes `rows` times `stride` steps, and puts the states between them into the block.
template <class T>
Status Integration<T>::fill(std::int64_t stride, std::int64_t rows) {
  if (adaptive()) return fill_adaptive(rows);
  block_.t0 = start_.t0, block_.h = start_.h;
  block_.stride = stride, block_.first = taken_ + stride;
  std::int64_t completed = 0;
  try {
    const Status status = stepper_->fill(block_, static_cast<std::size_t>(rows), state_, completed);
    taken_ += completed;
    return status;
  } catch (...) {
    taken_ += completed;
    throw;
  }
}

// Goes on to the times of the next `rows` intervals.
template <class T>
Status Integration<T>::fill_adaptive(std::int64_t rows) {
  block_.t0 = start_.t0, block_.h = start_.h;
  block_.stride = 1, block_.first = taken_ + 1;
  block_.rows = 0;
  block_.times.clear();
  for (; static_cast<std::int64_t>(block_.rows) < rows; ++taken_) {
    if (const Status status = advance_to(time_of(taken_ + 1)); status != Status::converged) return status;
    block_.times.push_back(reached_);
    block_.states.put(block_.rows++, state_.data());
  }
  return Status::converged;
}

// Gives somebody who watches the rows of the block that are to be seen.
template <class T>
void Integration<T>::thin(Watching& watching) {
  const std::int64_t every = adaptive() ? watching.every : watching.every / block_.stride;
  watching.shown = &block_;
  if (every == 1) return;
  if (watching.thinned == nullptr)
    watching.thinned = std::make_unique<Block<T>>(state_.size(), block_.capacity);
  Block<T>& thinned = *(watching.shown = watching.thinned.get());
  thinned.t0 = block_.t0, thinned.h = block_.h, thinned.stride = watching.every;
  thinned.rows = 0;
  thinned.times.clear();
  thinned.first = block_.first + lattice_behind(block_.first, watching.every);
  std::vector<T> z(state_.size());
  for (std::size_t row = block_.row_of(thinned.first); row < block_.rows;
       row += static_cast<std::size_t>(every)) {
    block_.states.get(row, z);
    thinned.states.put(thinned.rows++, z.data());
    if (!block_.times.empty()) thinned.times.push_back(block_.times[row]);
  }
  thinned.states.fill_behind(thinned.rows);
}

namespace {
// Leaves out the rows behind those after `step` steps.
template <class T>
void end_at(std::int64_t step, Block<T>& block) {
  while (block.rows > 0 && block.step(block.rows - 1) > step) --block.rows;
  if (!block.times.empty()) block.times.resize(block.rows);
  block.states.fill_behind(block.rows);
}
}  // namespace

// Shows the block to the watchers; true where one of them ends the run at a row of it.
template <class T>
bool Integration<T>::look() {
  const std::size_t filled = block_.rows;
  std::size_t last = filled;
  block_.states.fill_behind(filled);
  for (Watching& w : watching_) {
    thin(w);
    if (w.watcher == nullptr || w.shown->rows == 0) continue;
    const std::size_t row = w.watcher->end(*this, *w.shown);
    if (row < w.shown->rows) last = std::min(last, block_.row_of(w.shown->step(row)));
  }
  const bool ends = last < filled;
  if (ends) {
    // What the stepper remembers belongs to the end of the block.
    taken_ = block_.step(last);
    if (adaptive()) reached_ = block_.time(last);
    block_.states.get(last, state_);
    stepper_->forget();
    for (const Watching& w : watching_) end_at(taken_, *w.shown);
  }
  for (const Watching& w : watching_)
    if (w.watcher != nullptr && w.shown->rows > 0) w.watcher->look(*this, *w.shown);
  close_up();
  return ends;
}

// As fill(), and shows the rows to the watchers. `ends`: one of them ends the run, at a row before whatever
// failed or was thrown.
template <class T>
Status Integration<T>::fill_and_look(std::int64_t stride, std::int64_t rows, bool& ends) {
  Status status = Status::converged;
  try {
    status = fill(stride, rows);
  } catch (...) {
    ends = look();
    if (!ends) throw;
    return Status::converged;
  }
  ends = look();
  return status;
}

// After `steps` steps in a row whose end is not finite, and which are left as they began: takes those that
// are finite one by one.
template <class T>
void Integration<T>::up_to_the_failure(std::int64_t steps) {
  for (std::int64_t k = 0; k + 1 < steps; ++k) {
    std::int64_t completed = 0;
    const Status status = stepper_->advance(start_.t0, taken_, start_.h, 1, state_, completed);
    taken_ += completed;
    if (status != Status::converged) return;
  }
}

template <class T>
Outcome Integration<T>::steps(std::int64_t count) {
  if (count < 0) throw InputError("steps: expected a whole number >= 0; turn() and reversed() go back");
  if (adaptive() && count > 0 && value_of(start_.h) == Value<T>(0))
    throw InputError(
        "step: expected the time between two looks beside the tolerance, got 0; to() needs none");
  close_up();
  const std::int64_t begin = taken_, most = static_cast<std::int64_t>(start_.block_rows);
  const std::int64_t end = count > std::numeric_limits<std::int64_t>::max() - std::max<std::int64_t>(0, begin)
                               ? std::numeric_limits<std::int64_t>::max()
                               : begin + count;
  const bool watched = !watching_.empty();
  // Every look takes a processed method its processor.
  std::int64_t stride = method().processed() && !watched ? count : 0;
  for (const Watching& w : watching_) stride = std::gcd(stride, w.every);
  if (stride == 0 || adaptive()) stride = 1;
  return guarded(begin, [&]() -> Outcome {
    while (taken_ < end) {
      const std::int64_t left = end - taken_,
                         to_look = watched ? 1 + lattice_behind(taken_ + 1, stride) : stride;
      const std::int64_t by = std::min(to_look, left), rows = by == stride ? std::min(most, left / by) : 1;
      bool ends = false;
      const Status status = watched && to_look <= left ? fill_and_look(by, rows, ends) : fill(by, rows);
      if (ends) return ended(begin, Outcome::End::watcher, Status::converged);
      if (status == Status::non_finite && !adaptive()) up_to_the_failure(by);
      if (status != Status::converged) return ended(begin, Outcome::End::failed, status);
    }
    return ended(begin, Outcome::End::reached, Status::converged);
  });
}

template <class T>
Status Integration<T>::advance_to(const T& t) {
  return stepper_->advance_to(reached_, t, {start_.tolerance, start_.absolute, start_.tolerance_forgets},
                              state_);
}

// With a tolerance, to a time at which nobody looks.
template <class T>
Outcome Integration<T>::to_between(const T& t, std::int64_t begin) {
  return guarded(begin, [&]() -> Outcome {
    const Status status = advance_to(t);
    return ended(begin, status == Status::converged ? Outcome::End::reached : Outcome::End::failed, status);
  });
}

namespace {
// The least whole number that is not below x, of which |x| is below 9e18.
template <class V>
std::int64_t ceiling(const V& x) {
  const auto below = static_cast<std::int64_t>(std::floor(static_cast<double>(x)));
  return V(static_cast<double>(below)) < x ? below + 1 : below;
}
}  // namespace

template <class T>
Outcome Integration<T>::to(const T& t) {
  using V = Value<T>;
  const V end = value_of(t), t0 = value_of(start_.t0), h = value_of(start_.h);
  if (!isfinite(end)) throw InputError("to: expected a finite time");
  if (h == V(0)) return to_between(t, taken_);
  // Both times are rounded, and so is what lies between them.
  const V steps_from_start = (end - t0) / h;
  const V slack = V(1e-9) + V(4) * std::numeric_limits<V>::epsilon() * (abs(end) + abs(t0)) / abs(h);
  if (!(abs(steps_from_start) < V(9e18) && slack < V(0.5)))
    throw InputError("to: expected a time that whole steps reach");
  const auto refuse_behind = [&] {
    throw InputError("to: t = " + to_string(Quad(end), 10) + " lies behind t = " +
                     to_string(Quad(value_of(time())), 10) + "; turn() and reversed() go back");
  };
  if (!adaptive()) {
    const std::int64_t whole = ceiling(V(steps_from_start - slack));
    if (whole < taken_) refuse_behind();
    return steps(whole - taken_);
  }
  if ((end - value_of(reached_)) / h < -slack) refuse_behind();
  // Intervals end where they would without the call, and the last one at t, if it does not end there anyway.
  const std::int64_t whole = -ceiling(V(-(steps_from_start + slack)));
  Outcome outcome = steps(std::max<std::int64_t>(0, whole - taken_));
  if (!outcome.reached() || abs(end - value_of(reached_)) <= slack * abs(h)) return outcome;
  return to_between(t, taken_ - outcome.steps());
}

template class Integration<double>;
template class Integration<Quad>;
template Integration<StepDual<double>> Integration<double>::differentiated(std::size_t) const;
template Integration<StepDual<Quad>> Integration<Quad>::differentiated(std::size_t) const;
template class Integration<StepDual<double>>;
template class Integration<StepDual<Quad>>;

}  // namespace pfaff
