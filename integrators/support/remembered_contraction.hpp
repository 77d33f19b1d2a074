// What an iteration is known to gain in one round, remembered from the steps before.
//
// A contraction is the ratio of the second correction of an iteration to the first
// (Convergence::contraction). With one that is remembered, a step can tell from its first correction how
// large the next one would be, and stop before it is computed. A step that stops so early measures no
// contraction itself, which is why the ratio has to be remembered. What is worth remembering is the method's
// choice:
//
//   remember_last     the ratio follows the motion. The method has to measure anew from time to time.
//   remember_slowest  the ratio is the largest seen since the start, so that it never has to be measured
//                     anew, and errs towards one iteration too many.
#pragma once

#include <algorithm>

namespace pfaff {

/// The contraction of an iteration in steps before; unknown until one has been measured. Measurements are
/// ratios of positive size, or 0 from a step in which there was nothing to measure, which changes nothing.
template <class Number>
class RememberedContraction {
 public:
  void forget() { ratio_ = Number(0); }
  [[nodiscard]] bool known() const { return ratio_ > Number(0); }
  /// The ratio remembered; 1, the ratio of an iteration that gains nothing, while none is known.
  [[nodiscard]] Number ratio() const { return known() ? ratio_ : Number(1); }

  /// Keeps the ratio measured last. True when there was one.
  bool remember_last(const Number& measured) {
    if (measured == Number(0)) return false;
    ratio_ = measured;
    return true;
  }
  /// Keeps the largest of the ratios measured. One that does not contract, 1 or more, gives way to the next.
  void remember_slowest(const Number& measured) {
    if (measured > Number(0)) ratio_ = ratio_ < Number(1) ? std::max(ratio_, measured) : measured;
  }

 private:
  Number ratio_{0};
};

}  // namespace pfaff
