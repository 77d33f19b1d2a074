// Convergence at round-off: when an iteration has nothing left to gain.
//
// Corrections are judged componentwise against the size of the component and of its change over the step, so
// that variables of very different magnitude (an exponentially growing chart momentum beside a decaying
// coordinate) are all solved to their own round-off. Derivative parts of duals are judged in the same way, so
// that a differentiated step is the derivative of the converged step. An iteration ends when every correction
// is well below one unit of round-off, or will be after the next contraction, or when corrections stagnate
// near round-off. Iterations that take long to converge ask in between whether the work was told to end.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// max over parts of |delta| / scale, where scale is the larger of two reference values, part by part.
template <class T>
Value<T> relative_size(const T& delta, const T& reference, const T& change) {
  const Value<T> d = abs(value_of(delta));
  const Value<T> scale = std::max(abs(value_of(reference)), abs(value_of(change)));
  // A NaN must not vanish: it passes through the division and through the last line. A correction of zero is
  // divided like any other, because the processor cannot predict which one is zero, and a wrong prediction
  // costs more than the division.
  if (scale > Value<T>(0)) return d / scale;
  return d > Value<T>(0) ? std::numeric_limits<Value<T>>::infinity() : d;
}
template <class T, int N>
Value<T> relative_size(const Dual<T, N>& delta, const Dual<T, N>& reference, const Dual<T, N>& change) {
  Value<T> size = relative_size(delta.value, reference.value, change.value);
  // One scale for all directions of a component: some of its derivatives may be zero or nearly so.
  Value<T> scale(0), largest(0);
  for (std::size_t k = 0; k < N; ++k) {
    scale = std::max({scale, abs(value_of(reference.derivative[k])), abs(value_of(change.derivative[k]))});
    largest = std::max(largest, abs(value_of(delta.derivative[k])));
    if (isnan(value_of(delta.derivative[k]))) return value_of(delta.derivative[k]);
  }
  if (largest > Value<T>(0))
    size = std::max(size, scale > Value<T>(0) ? largest / scale : std::numeric_limits<Value<T>>::infinity());
  return size;
}

/// How the corrections of an iteration become smaller, and so what the last two foretell of the next one.
enum class Corrections {
  /// By about the same ratio each time: one forecast that the next correction is lost in rounding is enough.
  even,
  /// By ratios that vary: a small one may be followed by one that is a thousand times larger, and corrections
  /// may stall and shrink in turns. Two forecasts in turn are needed: of the last ratio, or of what two
  /// iterations gain together.
  uneven,
  /// By stalling and contracting in turns, as where one unknown lags an iteration behind another: no forecast
  /// ends the iteration.
  in_turns
};

/// Watches the corrections of one iteration.
template <class T>
class Convergence {
 public:
  using Number = Value<T>;

  Convergence() = default;
  explicit Convergence(Corrections corrections) : corrections_(corrections) {}

  /// Call before the corrections of an iteration are added.
  void begin_iteration() {
    oldest_ = older_;
    older_ = previous_;
    previous_ = size_;
    size_ = Number(0);
    finite_ = true;
    ++iterations_;
  }
  /// One component's correction.
  void add(const T& delta, const T& reference, const T& change) {
    const Number s = relative_size(delta, reference, change);
    if (isnan(s)) finite_ = false;
    if (s > size_) size_ = s;
  }
  /// True when the iteration should stop; `status()` then says how. Corrections already seen are to be
  /// applied. `known_contraction` is the ratio by which corrections shrank in earlier iterations like this
  /// one; 1 where it is not known. With it the first correction may be the last: it is when the next one,
  /// even at 100 times that ratio, would be well below round-off.
  bool finished(int limit, const Number& known_contraction = Number(1)) {
    const Number u = unit_roundoff<T>();
    if (!finite_) return stop(Status::non_finite);
    idle_ = size_ < smallest_ ? 0 : idle_ + 1;
    smallest_ = std::min(smallest_, size_);
    if (size_ <= u / Number(8)) return stop(Status::converged);
    if (iterations_ == 1 && Number(100) * known_contraction * size_ <= u / Number(64))
      return stop(Status::converged);
    if (iterations_ >= 2) {
      const Number ratio = size_ / previous_;
      if (iterations_ == 2 && previous_ > Number(1024) * u) contraction_ = ratio;
      // The next correction would be ratio * size. The first correction of a component that was zero is
      // infinitely large in units of it, and the ratio to such a one is zero, which foretells nothing.
      const bool foretold = previous_ < std::numeric_limits<Number>::infinity() && ratio < Number(0.5) &&
                            ratio * size_ <= u / Number(64);
      if (foretold &&
          (corrections_ == Corrections::even || (corrections_ == Corrections::uneven && foretold_)))
        return stop(Status::converged);
      if (corrections_ == Corrections::uneven && foretold_by_pairs()) return stop(Status::converged);
      foretold_ = foretold;
      if (lost_in_rounding()) return stop(Status::converged);
    }
    if (iterations_ >= limit) return stop(Status::not_converged);
    if (iterations_ % 8 == 0) spend(0, 0);
    return false;
  }
  /// The last contraction ratio; 1 before two iterations are done.
  [[nodiscard]] Number ratio() const { return iterations_ < 2 ? Number(1) : size_ / previous_; }
  /// The ratio of the second correction to the first, where the first was far enough above round-off for the
  /// ratio to mean something; otherwise 0.
  [[nodiscard]] Number contraction() const { return contraction_; }
  [[nodiscard]] int iterations() const { return iterations_; }
  [[nodiscard]] Status status() const { return status_; }

 private:
  bool stop(Status status) {
    status_ = status;
    return true;
  }
  // What two iterations gain, in this one and in the one before, leaves nothing of the next correction.
  // Whether the correction is one of those that stall makes no difference to it.
  [[nodiscard]] bool foretold_by_pairs() const {
    if (iterations_ < 4 || !(oldest_ < std::numeric_limits<Number>::infinity())) return false;
    const Number gain = std::max(Number(size_ / older_), Number(previous_ / oldest_));
    return gain < Number(0.5) && gain * std::max(size_, previous_) <= unit_roundoff<T>() / Number(64);
  }
  // Round-off noise of a converged iteration, amplified by the sums it passes through, brings no correction
  // that is smaller than the smallest so far. Corrections that stall and shrink in turns do every few
  // iterations, and the longer the wait is the larger the noise may be.
  [[nodiscard]] bool lost_in_rounding() const {
    const Number u = unit_roundoff<T>();
    return (idle_ >= 1 && size_ <= Number(4) * u) || (idle_ >= 3 && size_ <= Number(256) * u) ||
           (idle_ >= 6 && size_ <= Number(65536) * u);
  }
  Number size_{0}, previous_{0}, older_{0}, oldest_{0};  // of the corrections, the last one first
  Number smallest_ = std::numeric_limits<Number>::infinity(), contraction_{0};
  int iterations_ = 0, idle_ = 0;  // idle: without a correction smaller than all before it
  bool finite_ = true, foretold_ = false;
  Corrections corrections_ = Corrections::even;
  Status status_ = Status::not_converged;
};

}  // namespace pfaff
