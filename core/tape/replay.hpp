// Replay: evaluates a tape with any scalar.
//
// The replay owns every buffer it needs, so that one tape serves many threads, each with its own replay. What
// depends on time alone is recomputed only when the time changes. Doubles take the instructions by operation
// (schedule.hpp), other scalars as the tape has them.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/recorder.hpp>
#include <pfaff/core/tape/schedule.hpp>

namespace pfaff {

/// Solves the dense systems of a tape; specialised for scalars that record instead of computing.
template <class T>
class TapeSolver {
 public:
  explicit TapeSolver(int size) : lu_(static_cast<std::size_t>(size)), b_(lu_.size()), x_(lu_.size()) {}

  /// Writes the solution to slots[first, first + size). A singular matrix gives non-finite components.
  void operator()(const LinearSystem& system, std::vector<T>& slots, std::size_t first) {
    solve(
        system, [&](int slot) -> const T& { return slots[static_cast<std::size_t>(slot)]; },
        [&](std::size_t i, const T& x) { slots[first + i] = x; });
  }
  /// The same with slots that read(slot) returns, and write(i, x) for component i of the solution.
  template <class Read, class Write>
  void solve(const LinearSystem& system, const Read& read, const Write& write) {
    const std::size_t n = lu_.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) lu_(i, j) = read(system.matrix[i * n + j]);
      b_[i] = read(system.right_hand_side[i]);
    }
    if (lu_.factor()) {
      lu_.solve(b_.data(), x_.data());
    } else {
      for (T& x : x_) x = T(std::numeric_limits<double>::quiet_NaN());
    }
    for (std::size_t i = 0; i < n; ++i) write(i, x_[i]);
  }

 private:
  LU<T> lu_;
  std::vector<T> b_, x_;
};

/// Every lane has pivots of its own.
template <int W>
class TapeSolver<Pack<W>> {
 public:
  explicit TapeSolver(int size) : one_(size) {}
  void operator()(const LinearSystem& system, std::vector<Pack<W>>& slots, std::size_t first) {
    for (std::size_t lane = 0; lane < W; ++lane)
      one_.solve(
          system, [&](int slot) { return slots[static_cast<std::size_t>(slot)][lane]; },
          [&](std::size_t i, double x) { slots[first + i].set(lane, x); });
  }

 private:
  TapeSolver<double> one_;
};

template <>
class TapeSolver<Recorded> {
 public:
  explicit TapeSolver(int size) : size_(static_cast<std::size_t>(size)) {}
  void operator()(const LinearSystem& system, std::vector<Recorded>& slots, std::size_t first) const;

 private:
  std::size_t size_;
};

/// A x = b and its derivative A x' = b' - A' x, both recorded.
template <>
class TapeSolver<Dual<Recorded, 1>> {
 public:
  explicit TapeSolver(int size) : size_(static_cast<std::size_t>(size)) {}
  void operator()(const LinearSystem& system, std::vector<Dual<Recorded, 1>>& slots, std::size_t first) const;

 private:
  std::size_t size_;
};

namespace detail {
/// The order in which a tape is evaluated with a scalar. An operation of quad takes so much longer than a
/// jump that a schedule by operation is not worth its making.
template <class T>
inline constexpr ScheduleOrder schedule_order = ScheduleOrder::recorded;
template <>
inline constexpr ScheduleOrder schedule_order<double> = ScheduleOrder::by_operation;
template <int W>
inline constexpr ScheduleOrder schedule_order<Pack<W>> = ScheduleOrder::by_operation;
template <class T, int N>
inline constexpr ScheduleOrder schedule_order<Dual<T, N>> = schedule_order<T>;
}  // namespace detail

/// Evaluates one tape again and again.
template <class T>
class Replay {
 public:
  explicit Replay(std::shared_ptr<const Tape> tape) : tape_(std::move(tape)), slots_(tape_->code.size()) {
    const auto time_begin = static_cast<std::size_t>(tape_->time_begin),
               state_begin = static_cast<std::size_t>(tape_->state_begin);
    for (std::size_t k = 0; k < time_begin; ++k)
      slots_[k] = T(tape_->constants[static_cast<std::size_t>(tape_->code[k].a)]);
    of_time_ = Schedule(*tape_, time_begin, state_begin, detail::schedule_order<T>);
    of_state_ = Schedule(*tape_, state_begin, slots_.size(), detail::schedule_order<T>);
    for (const LinearSystem& system : tape_->solves) solvers_.emplace_back(system.size);
  }

  /// outputs = formula(t, z); `z` has tape().inputs numbers, `outputs` tape().outputs.size().
  void operator()(const T& t, const T* z, T* outputs) {
    if (!(timed_ && same_time(t))) {
      time_ = t;
      timed_ = true;
      run(of_time_, z);
    }
    run(of_state_, z);
    for (std::size_t k = 0; k < tape_->outputs.size(); ++k)
      outputs[k] = slots_[static_cast<std::size_t>(tape_->outputs[k])];
  }

  [[nodiscard]] const Tape& tape() const { return *tape_; }
  /// The value of every slot after the last evaluation.
  [[nodiscard]] const std::vector<T>& slots() const { return slots_; }

 private:
  [[nodiscard]] bool same_time(const T& t) const {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Quad>) return t == time_;
    return false;
  }

  // A product with a zero that is recorded says that its domain counts, and is recorded anew.
  T product(const ScheduledInstruction& i, const T* x) const {
    if constexpr (std::is_same_v<T, Recorded>)
      if (i.a < tape_->time_begin && x[i.a].is(0)) return nothing_of(x[i.b]);
    return x[i.a] * x[i.b];
  }

  void run(const Schedule& schedule, const T* z) {
    T* x = slots_.data();
    for (const OperationRun& of_one : schedule.runs) {
      const ScheduledInstruction* i = schedule.instructions.data() + of_one.begin;
      const ScheduledInstruction* const end = schedule.instructions.data() + of_one.end;
      switch (of_one.operation) {
        case Operation::constant:
        case Operation::cosine:
        case Operation::solve_next:
          break;  // in no schedule
        case Operation::time:
          for (; i != end; ++i) x[i->slot] = time_;
          break;
        case Operation::input:
          for (; i != end; ++i) x[i->slot] = z[i->a];
          break;
        case Operation::negate:
          for (; i != end; ++i) x[i->slot] = -x[i->a];
          break;
        case Operation::add:
          for (; i != end; ++i) x[i->slot] = x[i->a] + x[i->b];
          break;
        case Operation::subtract:
          for (; i != end; ++i) x[i->slot] = x[i->a] - x[i->b];
          break;
        case Operation::multiply:
          for (; i != end; ++i) x[i->slot] = product(*i, x);
          break;
        case Operation::divide:
          for (; i != end; ++i) x[i->slot] = x[i->a] / x[i->b];
          break;
        case Operation::square_root:
          for (; i != end; ++i) x[i->slot] = sqrt(x[i->a]);
          break;
        case Operation::exponential:
          for (; i != end; ++i) x[i->slot] = exp(x[i->a]);
          break;
        case Operation::logarithm:
          for (; i != end; ++i) x[i->slot] = log(x[i->a]);
          break;
        case Operation::sine:
          for (; i != end; ++i) sine_cosine(x[i->a], x[i->slot], x[i->slot + 1]);
          break;
        case Operation::power:
          for (; i != end; ++i) x[i->slot] = pow(x[i->a], tape_->constants[static_cast<std::size_t>(i->b)]);
          break;
        case Operation::special:
          for (; i != end; ++i) x[i->slot] = special(static_cast<SpecialFunction>(i->c), x[i->a], x[i->b]);
          break;
        case Operation::select:
          for (; i != end; ++i) x[i->slot] = select(x[i->a], x[i->b], x[i->c]);
          break;
        case Operation::solve:
          for (; i != end; ++i) {
            const auto s = static_cast<std::size_t>(i->a);
            solvers_[s](tape_->solves[s], slots_, static_cast<std::size_t>(i->slot));
          }
          break;
      }
    }
  }

  std::shared_ptr<const Tape> tape_;
  Schedule of_time_, of_state_;
  std::vector<T> slots_;
  std::vector<TapeSolver<T>> solvers_;
  T time_{};
  bool timed_ = false;
};

// Compiled once, in core/tape/replay.cpp, as the build says for that source alone.
extern template class Replay<double>;
extern template class Replay<Quad>;

}  // namespace pfaff
