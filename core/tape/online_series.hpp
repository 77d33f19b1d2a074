// OnlineSeries: a scalar for truncated power series, in W lanes at once. A formula that is run with it once
// for each level extends its own series by one coefficient each time. It is the compiled counterpart of
// SeriesReplay (series.hpp).
//
// Every operation of the formula takes the next slot of the workspace, slot[levels], and computes one
// coefficient there from the coefficients below it. Slots are counted in the order in which the formula runs,
// which is the same at every level. Once everything is inlined, the compiler knows the number of each slot,
// what is constant and what depends on time alone; only the recurrences are left, on fixed addresses. The
// formula must therefore run the same operations every time: no branch on values, as for every formula here.
// What depends on time alone is computed in a pass of its own.
//
// Limits: levels <= series_capacity; the formula's size is a constant; at level 0 all lanes have one time and
// one state, so that functions are evaluated there once for all of them.
#pragma once

#include <cmath>
#include <cstddef>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/pack.hpp>
#include <pfaff/core/tape/recurrences.hpp>

namespace pfaff {

/// Coefficients kept for each slot.
inline constexpr int series_capacity = 16;

/// Which slots are computed when a formula runs: none (they are counted only), those of time alone, or those
/// that depend on the state.
enum class SeriesPass { none, time, state };

/// One run of a formula: which level it computes, and the slots taken so far.
template <int W>
struct SeriesRun {
  Pack<W>* slots;  // [slot][series_capacity]
  int level;
  SeriesPass pass;
  int next = 0;
  int timed = 0;              // how many of them depend on time alone, the time itself not counted
  int angle = -1, sine = -1;  // the last argument of a sine or cosine, and the slot of its sine
};

/// True where all lanes are zero.
template <int W>
bool nothing(const Pack<W>& x) {
  for (std::size_t lane = 0; lane < W; ++lane)
    if (x[lane] != 0) return false;
  return true;
}

template <int W>
class OnlineSeries {
  using P = Pack<W>;

 public:
  OnlineSeries() = default;
  OnlineSeries(int value) : constant_(value) {}  // NOLINT(google-explicit-constructor)
  explicit OnlineSeries(const Real& value) : constant_(value.value()) {}
  /// The series in a slot of the run; its coefficients beyond `degree` are zero by construction.
  OnlineSeries(SeriesRun<W>& run, int slot, bool of_time, int degree = series_capacity)
      : run_(&run), slot_(slot), of_time_(of_time), degree_(degree) {}

  /// The slot of this series. A constant has none of its own and takes the next one.
  int placed(SeriesRun<W>& run) const {
    if (run_ != nullptr) return slot_;
    const int slot = run.next++;
    if (run.pass == SeriesPass::state)
      run.slots[slot * series_capacity + run.level] = run.level == 0 ? P(constant_) : P(0);
    return slot;
  }

  friend OnlineSeries operator-(const OnlineSeries& a) {
    if (a.is_constant()) return number(-a.constant_);
    const OnlineSeries r = a.scaled_kind();
    if (r.active()) r.store(-a.at(a.level()));
    return r;
  }
  friend OnlineSeries operator+(const OnlineSeries& a, const OnlineSeries& b) {
    if (a.is_constant() && b.is_constant()) return number(a.constant_ + b.constant_);
    if (a.is_constant()) return b.shifted(a.constant_);
    if (b.is_constant()) return a.shifted(b.constant_);
    const OnlineSeries r = a.kind_with(b);
    const int l = a.level();
    if (r.active()) r.store(a.at(l) + b.at(l));
    return r;
  }
  friend OnlineSeries operator-(const OnlineSeries& a, const OnlineSeries& b) {
    if (a.is_constant() && b.is_constant()) return number(a.constant_ - b.constant_);
    if (b.is_constant()) return a.shifted(-b.constant_);
    const OnlineSeries r = b.kind_with(a);
    if (!r.active()) return r;
    const int l = b.level();
    r.store(!a.is_constant() ? a.at(l) - b.at(l) : l == 0 ? P(a.constant_) - b.at(0) : -b.at(l));
    return r;
  }
  friend OnlineSeries operator*(const OnlineSeries& a, const OnlineSeries& b) {
    if (a.is_constant() && b.is_constant()) return number(a.constant_ * b.constant_);
    if (a.is_constant()) return b.scaled(a.constant_);
    if (b.is_constant()) return a.scaled(b.constant_);
    const OnlineSeries r = a.kind_with(b);
    if (!r.active()) return r;
    r.store(a.slot_ == b.slot_ ? recurrences::square(a.all(), a.level())
                               : recurrences::product(a.all(), b.all(), a.level()));
    return r;
  }
  friend OnlineSeries operator/(const OnlineSeries& a, const OnlineSeries& b) {
    if (a.is_constant() && b.is_constant()) return number(a.constant_ / b.constant_);
    if (b.is_constant()) return a.scaled(1 / b.constant_);
    const OnlineSeries r = b.kind_with(a);
    if (!r.active()) return r;
    const int l = b.level();
    r.store(recurrences::quotient(a.coefficient(l), b.all(), r.all(), l));
    return r;
  }
  friend OnlineSeries sqrt(const OnlineSeries& a) {
    return a.extended([](double x) { return std::sqrt(x); },
                      [&](const P* r, int l) { return recurrences::square_root(a.all(), r, l); });
  }
  friend OnlineSeries exp(const OnlineSeries& a) {
    return a.extended([](double x) { return std::exp(x); },
                      [&](const P* r, int l) { return recurrences::from_slope(a.all(), r, l, a.last(l)); });
  }
  friend OnlineSeries log(const OnlineSeries& a) {
    return a.extended([](double x) { return std::log(x); },
                      [&](const P* r, int l) { return recurrences::logarithm(a.all(), r, l); });
  }
  /// a^y for a constant exponent.
  friend OnlineSeries pow(const OnlineSeries& a, const Real& y) {
    return a.extended([&y](double x) { return pow(x, y); },
                      [&](const P* r, int l) { return recurrences::power(a.all(), y.value(), r, l); });
  }
  friend OnlineSeries special(SpecialFunction which, const OnlineSeries& a, const OnlineSeries& slope) {
    return a.extended(
        [which](double x) { return special(which, x, 0.0); },
        [&](const P*, int l) { return recurrences::from_slope(a.all(), slope.all(), l, a.last(l)); });
  }
  friend OnlineSeries sin(const OnlineSeries& a) {
    if (a.is_constant()) return number(std::sin(a.constant_));
    return {*a.run_, a.sine_and_cosine(), a.of_time_};
  }
  friend OnlineSeries cos(const OnlineSeries& a) {
    if (a.is_constant()) return number(std::cos(a.constant_));
    return {*a.run_, a.sine_and_cosine() + 1, a.of_time_};
  }
  /// The branch by the sign of the condition's value, lane by lane.
  friend OnlineSeries select(const OnlineSeries& condition, const OnlineSeries& positive,
                             const OnlineSeries& otherwise) {
    if (condition.is_constant()) return condition.constant_ > 0 ? positive : otherwise;
    const OnlineSeries r =
        condition.next_slot(condition.of_time_ && positive.of_time() && otherwise.of_time());
    if (!r.active()) return r;
    P value;
    const P a = positive.coefficient(condition.level()), b = otherwise.coefficient(condition.level());
    for (std::size_t lane = 0; lane < W; ++lane)
      value.set(lane, condition.at(0)[lane] > 0 ? a[lane] : b[lane]);
    r.store(value);
    return r;
  }

 private:
  static OnlineSeries number(double value) {
    OnlineSeries r;
    r.constant_ = value;
    return r;
  }
  [[nodiscard]] bool is_constant() const { return run_ == nullptr; }
  [[nodiscard]] bool of_time() const { return is_constant() || of_time_; }
  [[nodiscard]] int level() const { return run_->level; }
  // All coefficients.
  [[nodiscard]] P* all() const { return run_->slots + slot_ * series_capacity; }
  [[nodiscard]] const P& at(int level) const { return all()[level]; }
  [[nodiscard]] P coefficient(int level) const {
    return !is_constant() ? at(level) : level == 0 ? P(constant_) : P(0);
  }
  void store(const P& value) const { all()[level()] = value; }
  [[nodiscard]] bool active() const {
    return run_->pass == (of_time_ ? SeriesPass::time : SeriesPass::state);
  }
  [[nodiscard]] OnlineSeries next_slot(bool of_time) const {
    run_->timed += of_time ? 1 : 0;
    return {*run_, run_->next++, of_time};
  }
  [[nodiscard]] OnlineSeries scaled_kind() const {
    OnlineSeries r = next_slot(of_time_);
    r.degree_ = degree_;
    return r;
  }
  [[nodiscard]] OnlineSeries scaled(double factor) const {
    const OnlineSeries r = scaled_kind();
    if (r.active()) r.store(at(level()) * P(factor));
    return r;
  }
  [[nodiscard]] OnlineSeries shifted(double summand) const {
    const OnlineSeries r = scaled_kind();
    if (r.active()) r.store(level() == 0 ? at(0) + P(summand) : at(level()));
    return r;
  }
  // The last coefficient up to level l that is not zero by construction.
  [[nodiscard]] int last(int l) const { return l < degree_ ? l : degree_; }
  [[nodiscard]] OnlineSeries same_kind() const { return next_slot(of_time_); }
  [[nodiscard]] OnlineSeries kind_with(const OnlineSeries& o) const {
    return next_slot(of_time_ && o.of_time());
  }
  // f at level 0, where all lanes have the same number.
  template <class F>
  [[nodiscard]] P first(F f) const {
    return P(f(at(0)[0]));
  }
  // A function of this, f of its value and next(coefficients of the function, l) at the levels l above.
  template <class F, class Next>
  [[nodiscard]] OnlineSeries extended(F f, Next next) const {
    if (is_constant()) return number(f(constant_));
    const OnlineSeries r = same_kind();
    if (r.active()) r.store(level() == 0 ? first(f) : next(r.all(), level()));
    return r;
  }
  // The slot of the sine; that of the cosine follows.
  [[nodiscard]] int sine_and_cosine() const {
    if (run_->angle == slot_) return run_->sine;
    const OnlineSeries s = same_kind(), c = same_kind();
    run_->angle = slot_;
    run_->sine = s.slot_;
    if (!s.active()) return s.slot_;
    const int l = level();
    if (l == 0) {
      s.store(first([](double x) { return std::sin(x); }));
      c.store(first([](double x) { return std::cos(x); }));
      return s.slot_;
    }
    recurrences::sine_cosine(all(), s.all(), c.all(), l, last(l));
    return s.slot_;
  }

  SeriesRun<W>* run_ = nullptr;  // null: a constant
  int slot_ = 0;
  bool of_time_ = false;
  int degree_ = series_capacity;
  double constant_ = 0;
};

}  // namespace pfaff
