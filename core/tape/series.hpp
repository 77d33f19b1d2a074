// SeriesReplay: a tape evaluated in truncated power series, level by level, at several nodes (lanes) at once.
//
// Every slot holds x(s) = sum_l x_l s^l. Level l of every instruction needs levels 0..l of its operands only.
// A caller may therefore compute level l of its own unknowns from level l-1 of the outputs and go on (online
// evaluation). This turns the implicit collocation of a generating-function scheme into one explicit pass,
// and an ODE into its Taylor series. Slots that depend on time alone are computed for all levels when the
// time is set.
//
// The recurrences are those of recurrences.hpp, with sums that are added up for all lanes together; a linear
// solve is A_0 x_l = b_l - sum_{i>=1} A_i x_{l-i} with one factorisation of A_0.
//
// Where a_0 = 0 and a_m is the first coefficient that is not, a^r is of degree m r: its coefficients below
// are 0, and others are given only where a_0 is not 0.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// True where coefficient l of a^r is 0 because a_0 is, whatever the coefficients of a are that are not zero,
/// a_i = a[i step]. The derivatives that a scalar carries are coefficients of r a^(r - 1), and so on.
template <class T>
bool flat_power(const T* a, std::size_t step, std::size_t l, double r) {
  if (value_of(a[0]) != Value<T>(0)) return false;
  std::size_t m = 1;
  while (m <= l && value_of(a[m * step]) == Value<T>(0)) ++m;
  return static_cast<double>(m) * (r - derivative_depth<T>) > static_cast<double>(l);
}

template <class T>
class SeriesReplay {
 public:
  /// Series of `levels` terms (degrees 0 .. levels-1) in `lanes` lanes.
  SeriesReplay(std::shared_ptr<const Tape> tape, int levels, int lanes)
      : tape_(std::move(tape)),
        levels_(static_cast<std::size_t>(levels)),
        lanes_(static_cast<std::size_t>(lanes)),
        slots_(tape_->code.size() * levels_ * lanes_) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(tape_->time_begin); ++k) {
      const T constant(tape_->constants[static_cast<std::size_t>(tape_->code[k].a)]);
      for (std::size_t lane = 0; lane < lanes_; ++lane) slot(k, 0)[lane] = constant;
    }
    for (const LinearSystem& system : tape_->solves)
      for (std::size_t lane = 0; lane < lanes_; ++lane)
        factors_.emplace_back(static_cast<std::size_t>(system.size));
    int largest = 0;
    for (const LinearSystem& system : tape_->solves) largest = std::max(largest, system.size);
    rhs_.resize(static_cast<std::size_t>(largest));
    solution_.resize(static_cast<std::size_t>(largest));
    for (std::size_t k = static_cast<std::size_t>(tape_->state_begin); k < tape_->code.size(); ++k)
      if (tape_->code[k].operation == Operation::input) inputs_.push_back(k);
  }

  /// Time runs as t0[lane] + t1[lane] s. Recomputes what depends on time alone, at every level.
  void set_time(const T* t0, const T* t1) {
    t0_ = t0;
    t1_ = t1;
    for (std::size_t level = 0; level < levels_; ++level)
      run(static_cast<std::size_t>(tape_->time_begin), static_cast<std::size_t>(tape_->state_begin), level);
    t0_ = t1_ = nullptr;
  }

  /// Level `level` of every input: z[component * lanes + lane].
  void set_input(std::size_t level, const T* z) {
    for (const std::size_t k : inputs_) {
      const T* from = z + static_cast<std::size_t>(tape_->code[k].a) * lanes_;
      T* to = slot(k, level);
      for (std::size_t lane = 0; lane < lanes_; ++lane) to[lane] = from[lane];
    }
  }

  /// Computes level `level` of every state-dependent slot; levels below must be done, inputs set.
  void advance(std::size_t level) {
    run(static_cast<std::size_t>(tape_->state_begin), tape_->code.size(), level);
  }

  /// Level `level` of output k, one number per lane.
  const T* output(std::size_t k, std::size_t level) const {
    return slots_.data() + (static_cast<std::size_t>(tape_->outputs[k]) * levels_ + level) * lanes_;
  }

  /// The coefficient of level `level` in slot k of the first lane.
  [[nodiscard]] const T& coefficient(std::size_t k, std::size_t level) const {
    return slots_[(k * levels_ + level) * lanes_];
  }

  [[nodiscard]] std::size_t lanes() const { return lanes_; }
  [[nodiscard]] std::size_t levels() const { return levels_; }

 private:
  T* slot(std::size_t k, std::size_t level) { return slots_.data() + (k * levels_ + level) * lanes_; }
  [[nodiscard]] bool constant(int k) const { return k < tape_->time_begin; }

  // sum_{i=first}^{last} weight(i) a_i b_{level-i}, added to `to` in every lane.
  template <class Weight>
  void convolve(T* to, const T* a, const T* b, std::size_t level, std::size_t first, std::size_t last,
                Weight weight) {
    for (std::size_t i = first; i <= last; ++i) {
      const T* ai = a + i * lanes_;
      const T* bi = b + (level - i) * lanes_;
      const T w = weight(i);
      for (std::size_t lane = 0; lane < lanes_; ++lane) to[lane] = to[lane] + w * (ai[lane] * bi[lane]);
    }
  }
  void convolve(T* to, const T* a, const T* b, std::size_t level, std::size_t first, std::size_t last) {
    if constexpr (std::is_same_v<T, Quad>) {
      const auto step = static_cast<std::ptrdiff_t>(lanes_);
      for (std::size_t lane = 0; lane < lanes_ && first <= last; ++lane)
        to[lane] = sum_of_products(to[lane], a + first * lanes_ + lane, step,
                                   b + (level - first) * lanes_ + lane, -step, last + 1 - first);
      return;
    }
    for (std::size_t i = first; i <= last; ++i) {
      const T* ai = a + i * lanes_;
      const T* bi = b + (level - i) * lanes_;
      for (std::size_t lane = 0; lane < lanes_; ++lane) to[lane] = to[lane] + ai[lane] * bi[lane];
    }
  }

  void run(std::size_t begin, std::size_t end, std::size_t level) {
    for (std::size_t k = begin; k < end; ++k)
      if (level == 0) {
        start(k);
      } else {
        extend(k, level);
      }
  }

  // Level 0 of instruction k: plain arithmetic in every lane.
  void start(std::size_t k) {
    const Instruction i = tape_->code[k];
    T* x = slot(k, 0);
    const T* a = i.operation >= Operation::negate && i.operation <= Operation::select
                     ? slot(static_cast<std::size_t>(i.a), 0)
                     : nullptr;
    const auto b = [&] { return slot(static_cast<std::size_t>(i.b), 0); };
    const auto each = [&](auto&& value) {
      for (std::size_t lane = 0; lane < lanes_; ++lane) x[lane] = value(lane);
    };
    switch (i.operation) {
      case Operation::constant:
      case Operation::input:
      case Operation::cosine:
      case Operation::solve_next:
        break;
      case Operation::time:
        each([&](std::size_t n) { return t0_[n]; });
        break;
      case Operation::negate:
        each([&](std::size_t n) { return -a[n]; });
        break;
      case Operation::add:
        each([&, b = b()](std::size_t n) { return a[n] + b[n]; });
        break;
      case Operation::subtract:
        each([&, b = b()](std::size_t n) { return a[n] - b[n]; });
        break;
      case Operation::multiply:
        each([&, b = b()](std::size_t n) { return a[n] * b[n]; });
        break;
      case Operation::divide:
        each([&, b = b()](std::size_t n) { return a[n] / b[n]; });
        break;
      case Operation::square_root:
        each([&](std::size_t n) { return sqrt(a[n]); });
        break;
      case Operation::exponential:
        each([&](std::size_t n) { return exp(a[n]); });
        break;
      case Operation::logarithm:
        each([&](std::size_t n) { return log(a[n]); });
        break;
      case Operation::sine:
        for (std::size_t lane = 0; lane < lanes_; ++lane) sine_cosine(a[lane], x[lane], slot(k + 1, 0)[lane]);
        break;
      case Operation::power:
        each([&](std::size_t n) { return pow(a[n], tape_->constants[static_cast<std::size_t>(i.b)]); });
        break;
      case Operation::special:
        each([&, b = b()](std::size_t n) { return special(static_cast<SpecialFunction>(i.c), a[n], b[n]); });
        break;
      case Operation::select:
        each([&, b = b(), c = slot(static_cast<std::size_t>(i.c), 0)](std::size_t n) {
          return select(a[n], b[n], c[n]);
        });
        break;
      case Operation::solve:
        solve(k, 0);
        break;
    }
  }

  // Level l >= 1 of instruction k.
  void extend(std::size_t k, std::size_t l) {
    const Instruction i = tape_->code[k];
    T* x = slot(k, l);
    const T* a = i.operation >= Operation::negate && i.operation <= Operation::select
                     ? slot(static_cast<std::size_t>(i.a), 0)
                     : nullptr;
    const bool pair = (i.operation >= Operation::add && i.operation <= Operation::divide) ||
                      i.operation == Operation::special;
    const T* b = pair ? slot(static_cast<std::size_t>(i.b), 0) : nullptr;
    const T* x0 = slot(k, 0);
    const std::size_t at = l * lanes_;
    const auto each = [&](auto&& value) {
      for (std::size_t lane = 0; lane < lanes_; ++lane) x[lane] = value(lane);
    };
    const auto index = [](std::size_t n) { return T(static_cast<int>(n)); };
    switch (i.operation) {
      case Operation::constant:
      case Operation::input:
      case Operation::cosine:
      case Operation::solve_next:
        break;
      case Operation::time:
        each([&](std::size_t n) { return l == 1 ? t1_[n] : T(0); });
        break;
      case Operation::negate:
        each([&](std::size_t n) { return -a[at + n]; });
        break;
      case Operation::add:
        each([&](std::size_t n) { return a[at + n] + b[at + n]; });
        break;
      case Operation::subtract:
        each([&](std::size_t n) { return a[at + n] - b[at + n]; });
        break;
      case Operation::multiply:
        if (constant(i.a)) {
          each([&](std::size_t n) { return a[n] * b[at + n]; });
        } else if (constant(i.b)) {
          each([&](std::size_t n) { return a[at + n] * b[n]; });
        } else {
          each([](std::size_t) { return T(0); });
          convolve(x, a, b, l, 0, l);
        }
        break;
      case Operation::divide:
        if (constant(i.b)) {
          each([&](std::size_t n) { return a[at + n] / b[n]; });
        } else {
          each([](std::size_t) { return T(0); });
          convolve(x, b, x0, l, 1, l);
          each([&](std::size_t n) { return (a[at + n] - x[n]) / b[n]; });
        }
        break;
      case Operation::square_root:
        each([](std::size_t) { return T(0); });
        if (l >= 2) convolve(x, x0, x0, l, 1, l - 1);
        each([&](std::size_t n) { return (a[at + n] - x[n]) / (T(2) * x0[n]); });
        break;
      case Operation::exponential:
        each([](std::size_t) { return T(0); });
        convolve(x, a, x0, l, 1, l, index);
        each([&, order = index(l)](std::size_t n) { return x[n] / order; });
        break;
      case Operation::logarithm:
        each([](std::size_t) { return T(0); });
        if (l >= 2) convolve(x, x0, a, l, 1, l - 1, index);
        each([&, order = index(l)](std::size_t n) { return (a[at + n] - x[n] / order) / a[n]; });
        break;
      case Operation::sine: {
        const T* c0 = slot(k + 1, 0);
        T* c = slot(k + 1, l);
        for (std::size_t lane = 0; lane < lanes_; ++lane) x[lane] = c[lane] = T(0);
        convolve(x, a, c0, l, 1, l, index);
        convolve(c, a, x0, l, 1, l, index);
        const T order = index(l);
        for (std::size_t lane = 0; lane < lanes_; ++lane) {
          x[lane] = x[lane] / order;
          c[lane] = -c[lane] / order;
        }
        break;
      }
      case Operation::power: {
        const T r(tape_->constants[static_cast<std::size_t>(i.b)]);
        each([](std::size_t) { return T(0); });
        convolve(x, a, x0, l, 1, l, [&](std::size_t n) { return index(n) * r - index(l - n); });
        each([&, order = index(l)](std::size_t n) {
          return flat_power(a + n, lanes_, l, tape_->constants[static_cast<std::size_t>(i.b)].value())
                     ? T(0)
                     : x[n] / (order * a[n]);
        });
        break;
      }
      case Operation::special:
        each([](std::size_t) { return T(0); });
        convolve(x, a, b, l, 1, l, index);
        each([&, order = index(l)](std::size_t n) { return x[n] / order; });
        break;
      case Operation::select: {
        const T* p = slot(static_cast<std::size_t>(i.b), l);
        const T* q = slot(static_cast<std::size_t>(i.c), l);
        each([&](std::size_t n) { return select(a[n], p[n], q[n]); });
        break;
      }
      case Operation::solve:
        solve(k, l);
        break;
    }
  }

  void solve(std::size_t k, std::size_t level) {
    const auto s = static_cast<std::size_t>(tape_->code[k].a);
    const LinearSystem& system = tape_->solves[s];
    const auto n = static_cast<std::size_t>(system.size);
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      LU<T>& lu = factors_[s * lanes_ + lane];
      const auto matrix = [&](std::size_t r, std::size_t c, std::size_t l) {
        return slot(static_cast<std::size_t>(system.matrix[r * n + c]), l)[lane];
      };
      bool regular = true;
      if (level == 0) {
        for (std::size_t r = 0; r < n; ++r)
          for (std::size_t c = 0; c < n; ++c) lu(r, c) = matrix(r, c, 0);
        regular = lu.factor();
      }
      for (std::size_t r = 0; r < n; ++r) {
        rhs_[r] = slot(static_cast<std::size_t>(system.right_hand_side[r]), level)[lane];
        for (std::size_t i = 1; i <= level; ++i)
          for (std::size_t c = 0; c < n; ++c)
            rhs_[r] = rhs_[r] - matrix(r, c, i) * slot(k + c, level - i)[lane];
      }
      if (regular) lu.solve(rhs_.data(), solution_.data());
      for (std::size_t c = 0; c < n; ++c)
        slot(k + c, level)[lane] = regular ? solution_[c] : T(std::numeric_limits<double>::quiet_NaN());
    }
  }

  std::shared_ptr<const Tape> tape_;
  std::size_t levels_, lanes_;
  std::vector<T> slots_;  // [slot][level][lane]
  std::vector<LU<T>> factors_;
  std::vector<T> rhs_, solution_;
  std::vector<std::size_t> inputs_;
  const T* t0_ = nullptr;
  const T* t1_ = nullptr;
};

}  // namespace pfaff
