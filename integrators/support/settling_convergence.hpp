// Convergence of iterations that start from good predictions.
//
// Such an iteration has a first correction of some ten units of round-off, and a second one that is only
// round-off. The ratio of the two says nothing about the contraction of the iteration, so that Convergence,
// which foretells the next correction from it, goes on until the jitter stops by chance. What is known from
// earlier steps says more: where the correction is a few units of round-off, and the slowest contraction that
// was measured leaves less than a sixteenth of a unit of the next one, nothing is left to gain. The bound on
// the correction itself keeps an iteration going whose contraction has become slower since.
#pragma once

#include <algorithm>

#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/support/remembered_contraction.hpp>

namespace pfaff {

/// Watches the corrections of one iteration, and ends it where Convergence would, or sooner where the
/// contraction that is remembered says that it has settled.
template <class T>
class SettlingConvergence {
 public:
  using Number = Value<T>;

  explicit SettlingConvergence(Corrections corrections = Corrections::even) : convergence_(corrections) {}

  /// Call before the corrections of an iteration are added.
  void begin_iteration() {
    convergence_.begin_iteration();
    size_ = Number(0);
  }
  /// One component's correction, judged as by Convergence.
  void add(const T& delta, const T& reference, const T& change) {
    const Number size = relative_size(delta, reference, change);
    convergence_.add(T(size), T(1), T(1));
    size_ = std::max(size_, size);
  }
  /// True when the iteration should stop; `status()` then says how.
  bool finished(int limit, const RememberedContraction<Number>& remembered) {
    if (convergence_.finished(limit, remembered.ratio())) {
      status_ = convergence_.status();
      return true;
    }
    const Number u = unit_roundoff<T>();
    if (convergence_.iterations() < 2 || !(size_ <= Number(4) * u) ||
        !(remembered.ratio() * size_ <= u / Number(16)))
      return false;
    status_ = Status::converged;
    return true;
  }
  /// The contraction that this iteration has measured; see Convergence.
  [[nodiscard]] Number contraction() const { return convergence_.contraction(); }
  [[nodiscard]] int iterations() const { return convergence_.iterations(); }
  [[nodiscard]] Status status() const { return status_; }

 private:
  Convergence<T> convergence_;
  Number size_{0};
  Status status_ = Status::not_converged;
};

}  // namespace pfaff
