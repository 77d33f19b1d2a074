// Convergence at round-off: when an iteration has nothing left to gain.
//
// Corrections are judged componentwise against the size of the component and of its change over the step, so
// that variables of very different magnitude (an exponentially growing chart momentum beside a decaying
// coordinate) are all solved to their own round-off. Derivative parts of duals are judged in the same way, so
// that a differentiated step is the derivative of the converged step. An iteration ends when every correction
// is well below one unit of round-off, or will be after the next contraction, or when corrections stagnate
// near round-off, or further above it where a kick shows that this is rounding (stagnation.hpp). Iterations
// that take long to converge ask in between whether the work was told to end.
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/solve/relative_size.hpp>
#include <pfaff/core/solve/stagnation.hpp>

namespace pfaff {

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
  /// One component's correction; returns its relative size.
  Number add(const T& delta, const T& reference, const T& change) {
    const Number s = relative_size(delta, reference, change);
    if (isnan(s)) finite_ = false;
    if (s > size_) size_ = s;
    if (stagnation_) [[unlikely]]
      stagnation_->add(delta, reference, change);
    return s;
  }
  /// Numbers that are not corrected, but belong to what is solved, as positions where momenta are the
  /// unknowns: what rounding makes of corrections may be as large as it is of these (stagnation.hpp).
  void beside(std::span<const T> components) {
    if (stagnation_) [[unlikely]]
      for (const T& x : components) stagnation_->beside(x);
  }
  /// True when the iteration should stop; `status()` then says how. Corrections already seen are to be
  /// applied. `known_contraction` is the ratio by which corrections shrank in earlier iterations like this
  /// one; 1 where it is not known. With it the first correction may be the last: it is when the next one,
  /// even at 100 times that ratio, would be well below round-off.
  bool finished(int limit, const Number& known_contraction = Number(1)) {
    const Number u = unit_roundoff<T>();
    if (!finite_) return stop(Status::non_finite);
    if (stagnation_ && stagnation_->kicked()) [[unlikely]]
      return returned();
    idle_ = size_ < smallest_ ? 0 : idle_ + 1;
    still_ = size_ < smallest_ * Number(0.9375) ? 0 : still_ + 1;
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
    if (still_ >= 3 || stagnation_) [[unlikely]]
      watch_stagnation();
    if (iterations_ >= limit) return stop(Status::not_converged);
    if (iterations_ % 8 == 0) spend(0, 0);
    return false;
  }
  /// Call before corrections are added, with all that the next iterate is made of: makes a kick of them where
  /// the iteration stagnates, and returns true then.
  template <class Vector>
  bool kick(Vector& corrections) const {
    if (!stagnation_ || !stagnation_->kicks()) [[likely]]
      return false;
    for (T& x : corrections) x = T(Stagnation<T>::kick_factor) * x;
    return true;
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
  [[gnu::cold, gnu::noinline]] void watch_stagnation() {
    if (stagnation_) stagnation_->end_iteration(still_ >= 6);
    if (still_ == 0) stagnation_.reset();
    if (still_ == 3) stagnation_.emplace();
  }
  [[gnu::cold, gnu::noinline]] bool returned() {
    stagnation_->end_iteration(false);
    if (stagnation_->returned()) return stop(Status::converged);
    return stagnation_->lost() && stop(Status::not_converged);
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
           (still_ >= 6 && size_ <= Number(65536) * u);
  }
  Number size_{0}, previous_{0}, older_{0}, oldest_{0};  // of the corrections, the last one first
  Number smallest_ = std::numeric_limits<Number>::infinity(), contraction_{0};
  int iterations_ = 0, idle_ = 0;  // idle: without a correction smaller than all before it
  int still_ = 0;                  // the same, but for the last digits
  bool finite_ = true, foretold_ = false;
  Corrections corrections_ = Corrections::even;
  std::optional<Stagnation<T>> stagnation_;  // from where the iteration begins to idle
  Status status_ = Status::not_converged;
};

}  // namespace pfaff
