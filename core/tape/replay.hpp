// Replay: evaluates a tape with any scalar.
//
// The replay owns every buffer it needs, so that one tape serves many threads, each with its own replay. What
// depends on time alone is recomputed only when the time changes.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/recorder.hpp>

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

/// Evaluates one tape again and again.
template <class T>
class Replay {
 public:
  explicit Replay(std::shared_ptr<const Tape> tape) : tape_(std::move(tape)), slots_(tape_->code.size()) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(tape_->time_begin); ++k)
      slots_[k] = T(tape_->constants[static_cast<std::size_t>(tape_->code[k].a)]);
    for (const LinearSystem& system : tape_->solves) solvers_.emplace_back(system.size);
  }

  /// outputs = formula(t, z); `z` has tape().inputs numbers, `outputs` tape().outputs.size().
  void operator()(const T& t, const T* z, T* outputs) {
    if (!(timed_ && same_time(t))) {
      time_ = t;
      timed_ = true;
      run(static_cast<std::size_t>(tape_->time_begin), static_cast<std::size_t>(tape_->state_begin), z);
    }
    run(static_cast<std::size_t>(tape_->state_begin), slots_.size(), z);
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

  void run(std::size_t begin, std::size_t end, const T* z) {
    const Instruction* code = tape_->code.data();
    T* x = slots_.data();
    const auto at = [x](int slot) -> const T& { return x[static_cast<std::size_t>(slot)]; };
    for (std::size_t k = begin; k < end; ++k) {
      const Instruction i = code[k];
      switch (i.operation) {
        case Operation::constant:
          break;
        case Operation::time:
          x[k] = time_;
          break;
        case Operation::input:
          x[k] = z[i.a];
          break;
        case Operation::negate:
          x[k] = -at(i.a);
          break;
        case Operation::add:
          x[k] = at(i.a) + at(i.b);
          break;
        case Operation::subtract:
          x[k] = at(i.a) - at(i.b);
          break;
        case Operation::multiply:
          x[k] = at(i.a) * at(i.b);
          break;
        case Operation::divide:
          x[k] = at(i.a) / at(i.b);
          break;
        case Operation::square_root:
          x[k] = sqrt(at(i.a));
          break;
        case Operation::exponential:
          x[k] = exp(at(i.a));
          break;
        case Operation::logarithm:
          x[k] = log(at(i.a));
          break;
        case Operation::sine:
          sine_cosine(at(i.a), x[k], x[k + 1]);
          break;
        case Operation::cosine:
          break;
        case Operation::power:
          x[k] = pow(at(i.a), tape_->constants[static_cast<std::size_t>(i.b)]);
          break;
        case Operation::select:
          x[k] = select(at(i.a), at(i.b), at(i.c));
          break;
        case Operation::solve: {
          const auto s = static_cast<std::size_t>(i.a);
          solvers_[s](tape_->solves[s], slots_, k);
          break;
        }
        case Operation::solve_next:
          break;
      }
    }
  }

  std::shared_ptr<const Tape> tape_;
  std::vector<T> slots_;
  std::vector<TapeSolver<T>> solvers_;
  T time_{};
  bool timed_ = false;
};

}  // namespace pfaff
