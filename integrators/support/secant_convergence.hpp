// Convergence of iterations that are improved by secants (secant_updates.hpp).
//
// Their corrections become smaller by ratios that vary. Where values happen to be hit well a ratio may be ten
// thousand times smaller than the one before it, and the next correction, above all that of derivatives, is
// then ten thousand times larger than the last ratio foretells. The slower of the last two ratios foretells
// it; before there are two, the slowest first ratio of earlier steps stands for the one that is missing. An
// iteration without secants, whose ratios are even, ends where it would end by its last ratio alone.
//
// The ratio to a correction of a few units of round-off is one of rounding errors. There the ratio before it
// says whether anything is left to gain.
//
// A first correction that is larger than what it corrects, as that of a component that was nearly zero,
// measures no contraction: the ratio to it may be as small as that component, and foretells nothing.
#pragma once

#include <algorithm>

#include <pfaff/core/solve/convergence.hpp>

namespace pfaff {

/// Watches the corrections of one iteration, and ends it where Convergence would without a forecast, or where
/// the slower of the last two ratios leaves nothing of the next correction.
template <class T>
class SecantConvergence {
 public:
  using Number = Value<T>;

  /// Call before the corrections of an iteration are added.
  void begin_iteration() {
    convergence_.begin_iteration();
    previous_ = size_;
    size_ = Number(0);
  }
  /// One component's correction, judged as by Convergence.
  void add(const T& delta, const T& reference, const T& change) {
    const Number size = relative_size(delta, reference, change);
    convergence_.add(T(size), T(1), T(1));
    size_ = std::max(size_, size);
  }
  /// True when the iteration should stop; `status()` then says how. `known_contraction` is the slowest ratio
  /// of the second correction to the first in earlier steps, 1 where none is known.
  bool finished(int limit, const Number& known_contraction) {
    if (convergence_.finished(limit, known_contraction)) {
      status_ = convergence_.status();
      return true;
    }
    if (convergence_.iterations() == 1) {
      ratio_ = known_contraction;
      measures_ = size_ <= Number(1);
      return false;
    }
    const Number last = ratio_;
    ratio_ = previous_ <= Number(1) ? Number(size_ / previous_) : Number(1);
    const Number u = unit_roundoff<T>();
    const bool settled = size_ <= Number(4) * u && last * size_ <= u / Number(16);
    if (!settled && !(std::max(last, ratio_) * size_ <= u / Number(64))) return false;
    status_ = Status::converged;
    return true;
  }
  /// The contraction that this iteration has measured, see Convergence; 0 where it has measured none.
  [[nodiscard]] Number contraction() const { return measures_ ? convergence_.contraction() : Number(0); }
  [[nodiscard]] Status status() const { return status_; }

 private:
  Convergence<T> convergence_{Corrections::in_turns};
  Number size_{0}, previous_{0}, ratio_{1};
  bool measures_ = false;
  Status status_ = Status::not_converged;
};

}  // namespace pfaff
