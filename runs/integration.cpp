#include <pfaff/runs/integration.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

std::string failure(Status status, const std::string& where) {
  switch (status) {
    case Status::not_converged:
      return "the implicit solve did not converge " + where;
    case Status::singular:
      return "a linear system was singular " + where;
    case Status::non_finite:
      return "the state or the structure left the range of numbers " + where;
    case Status::converged:
      break;
  }
  return {};
}

std::string Outcome::message() const {
  switch (end_) {
    case End::failed:
      return failure(status_, where_);
    case End::watcher:
      return "a watcher ended the integration " + where_;
    case End::asked:
      return "the integration was interrupted " + where_;
    case End::reached:
      break;
  }
  return {};
}

void Outcome::expect_reached() const {
  if (!reached()) throw RunError(message());
}

namespace {
template <class T>
void check(const Start<T>& start) {
  const Model& model = *start.model;
  if (const std::string reason = start.method->refuses(model); !reason.empty()) throw InputError(reason);
  const auto dimension = static_cast<std::size_t>(model.dimension());
  if (start.state.size() != dimension)
    throw InputError("initial state of " + model.name() + ": expected " + std::to_string(dimension) +
                     " numbers, got " + std::to_string(start.state.size()));
  for (std::size_t i = 0; i < dimension; ++i)
    if (!isfinite(value_of(start.state[i])))
      throw InputError("initial state of " + model.name() + ": " + model.coordinates()[i].name +
                       " is not finite");
  const bool adaptive = value_of(start.tolerance) > Value<T>(0);
  if (!isfinite(value_of(start.h)) || (!adaptive && value_of(start.h) == Value<T>(0)))
    throw InputError("step: expected a finite number other than 0");
  if (!isfinite(value_of(start.t0))) throw InputError("initial time: expected a finite number");
  if (adaptive && !start.method->adaptive())
    throw InputError(start.method->called() + " takes fixed steps only; expected a step without a tolerance");
  if (!start.absolute.empty() && start.absolute.size() != dimension)
    throw InputError("absolute tolerances: expected none, or one for each of the " +
                     std::to_string(dimension) + " coordinates of " + model.name() + ", got " +
                     std::to_string(start.absolute.size()));
}
// A start that was checked, so that members can be made of it.
template <class T>
Start<T> checked(Start<T> start) {
  check(start);
  // What a watcher does once for a block is lost beside 256 rows, and a block should stay in the cache.
  if (start.block_rows == 0)
    start.block_rows = std::clamp<std::size_t>(8192 / std::max<std::size_t>(1, start.state.size()), 16, 256);
  return start;
}
}  // namespace

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
  reached_ = start_.t0 = time();
  start_.h = -start_.h;
  taken_ = 0;
}

template <class T>
void Integration<T>::watch(Watcher<T>& watcher, std::int64_t every) {
  if (every <= 0) throw InputError("watch: expected a whole number > 0 of steps between two looks");
  if (adaptive() && value_of(start_.h) == Value<T>(0))
    throw InputError("step: expected the time between two looks beside the tolerance, got 0");
  watcher.start(*this);  // one that throws does not watch
  watching_.push_back({&watcher, every});
}

template <class T>
Outcome Integration<T>::ended(std::int64_t begin, Outcome::End end, Status status) const {
  const std::string where = end == Outcome::End::reached ? ""
                                                         : "at t = " + to_string(Quad(value_of(time())), 10) +
                                                               " (step " + std::to_string(taken_) + ")";
  return {end, status, taken_ - begin, where};
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
  Status status = Status::converged;
  for (; static_cast<std::int64_t>(block_.rows) < rows; ++taken_) {
    status = advance_to(time_of(taken_ + 1));
    if (status != Status::converged) break;
    block_.times.push_back(reached_);
    block_.states.put(block_.rows++, state_.data());
  }
  block_.states.fill_behind(block_.rows);
  return status;
}

// Shows the block to the watchers; true where one of them ends the run at a row of it.
template <class T>
bool Integration<T>::look() {
  if (block_.rows == 0) return false;
  std::size_t last = block_.rows;
  for (const Watching& w : watching_) last = std::min(last, w.watcher->look(*this, block_));
  if (last >= block_.rows) return false;
  // What the stepper remembers belongs to the end of the block.
  taken_ = block_.step(last);
  if (adaptive()) reached_ = block_.time(last);
  block_.states.get(last, state_);
  stepper_->forget();
  return true;
}

// As fill(), and shows the rows to the watchers, those before an exception too. `ends`: one of them ends the
// run.
template <class T>
Status Integration<T>::fill_and_look(std::int64_t stride, std::int64_t rows, bool& ends) {
  Status status = Status::converged;
  try {
    status = fill(stride, rows);
  } catch (...) {
    (void)look();
    throw;
  }
  ends = look();
  return status;
}

template <class T>
Outcome Integration<T>::steps(std::int64_t count) {
  if (count < 0) throw InputError("steps: expected a whole number >= 0; turn() and reversed() go back");
  if (adaptive() && count > 0 && value_of(start_.h) == Value<T>(0))
    throw InputError(
        "step: expected the time between two looks beside the tolerance, got 0; to() needs none");
  const std::int64_t begin = taken_;
  return guarded(begin, [&]() -> Outcome {
    const std::int64_t end = taken_ + count, most = static_cast<std::int64_t>(start_.block_rows);
    const bool watched = !watching_.empty();
    // Every look takes a processed method its processor.
    std::int64_t stride = method().processed() && !watched ? count : 0;
    for (const Watching& w : watching_) stride = std::gcd(stride, w.every);
    if (stride == 0 || adaptive()) stride = 1;
    while (taken_ < end) {
      const std::int64_t left = end - taken_, to_look = watched ? stride - taken_ % stride : stride;
      const std::int64_t by = std::min(to_look, left), rows = by == stride ? std::min(most, left / by) : 1;
      bool ends = false;
      const Status status = watched && to_look <= left ? fill_and_look(by, rows, ends) : fill(by, rows);
      if (ends) return ended(begin, Outcome::End::watcher, Status::converged);
      if (status != Status::converged) return ended(begin, Outcome::End::failed, status);
    }
    return ended(begin, Outcome::End::reached, Status::converged);
  });
}

template <class T>
Status Integration<T>::advance_to(const T& t) {
  return stepper_->advance_to(reached_, t, {start_.tolerance, start_.absolute}, state_);
}

// With a tolerance, to a time at which nobody looks.
template <class T>
Outcome Integration<T>::to_between(const T& t, std::int64_t begin) {
  return guarded(begin, [&]() -> Outcome {
    const Status status = advance_to(t);
    return ended(begin, status == Status::converged ? Outcome::End::reached : Outcome::End::failed, status);
  });
}

template <class T>
Outcome Integration<T>::to(const T& t) {
  using V = Value<T>;
  if (!isfinite(value_of(t))) throw InputError("to: expected a finite time");
  const V h = value_of(start_.h), span = value_of(t) - value_of(time());
  if (h == V(0)) return to_between(t, taken_);
  const double ratio = static_cast<double>(V(span / h));
  const double slack = 1e-9 * std::max(1.0, std::abs(ratio));
  if (!(std::abs(ratio) < 9e18)) throw InputError("to: expected a time that whole steps reach");
  if (ratio < -slack)
    throw InputError("to: t = " + to_string(Quad(value_of(t)), 10) + " lies behind t = " +
                     to_string(Quad(value_of(time())), 10) + "; turn() and reversed() go back");
  if (!adaptive()) return steps(static_cast<std::int64_t>(std::ceil(ratio - slack)));
  // Intervals end where they would without the call, and the last one at t, if it does not end there anyway.
  const double intervals = static_cast<double>(V((value_of(t) - value_of(start_.t0)) / h));
  const auto whole = static_cast<std::int64_t>(std::floor(intervals + 1e-9));
  Outcome outcome = steps(std::max<std::int64_t>(0, whole - taken_));
  const V left = value_of(t) - value_of(reached_);
  if (!outcome.reached() || abs(left) <= V(1e-9) * abs(h)) return outcome;
  return to_between(t, taken_ - outcome.steps());
}

template class Integration<double>;
template class Integration<Quad>;
template class Integration<StepDual<double>>;
template class Integration<StepDual<Quad>>;

}  // namespace pfaff
