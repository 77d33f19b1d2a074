// Stagnation: whether corrections that become no smaller are rounding.
//
// What an iteration solves may round by far more than round-off of what it corrects. Where a motion comes to
// rest, forces cancel that are large beside a momentum of nearly zero; constants in a constraint may be large
// beside positions. Corrections become no smaller there, as they do where an iteration does not contract. An
// iteration that stagnates is therefore kicked away from where it is, by 65536 times its next correction. It
// has converged where it comes back by itself in ten iterations: what contracts in the large would
// contract in the small, were it not for rounding. Corrections must come back both where each is compared
// with its own component, so that those of small components count, and where the largest is compared with the
// largest component.
//
// Refused although sound: rounding above 2^33 units of round-off of the largest component, and what bends
// within 65536 times its rounding. Accepted although unsound: what stagnates at a kink or a jump that is
// smaller than that, in something straight far beyond it.
#pragma once

#include <algorithm>
#include <limits>

#include <pfaff/core/numbers/dual.hpp>
#include <pfaff/core/solve/largest.hpp>
#include <pfaff/core/solve/relative_size.hpp>

namespace pfaff {

/// Looks at the corrections of an iteration from where it begins to stagnate.
template <class T>
class Stagnation {
 public:
  using Number = Value<T>;

  /// One component's correction, the component before the step and its change or its present value.
  [[gnu::cold, gnu::noinline]] void add(const T& delta, const T& reference, const T& change) {
    correction_.add(delta);
    component_.add(reference);
    component_.add(change);
    const Number own = relative_size(delta, reference, reference);
    if (own < std::numeric_limits<Number>::infinity()) now_.own = std::max(now_.own, own);
  }
  /// A number that is not corrected, but belongs to what is solved.
  void beside(const T& component) { component_.add(component); }
  /// Call after the corrections of an iteration, `stagnates` where it is to be kicked if it may be.
  [[gnu::cold, gnu::noinline]] void end_iteration(bool stagnates) {
    const T component = component_.get();
    now_.largest = relative_size(correction_.get(), component, component);
    if (kick_ == Kick::none) {
      most_.own = std::max(most_.own, now_.own);
      most_.largest = std::max(most_.largest, now_.largest);
      if (stagnates && most_.largest <= Number(0x1p33) * unit_roundoff<T>()) kick_ = Kick::next;
    } else if (kick_ == Kick::next) {  // in vain where what stagnates is not what was kicked
      kick_ = far() ? Kick::back : Kick::vain;
    } else if (kick_ == Kick::back) {
      const bool near = now_.own <= Number(16) * most_.own && now_.largest <= Number(16) * most_.largest;
      if (++since_ > 1 && near)
        kick_ = Kick::returned;
      else if (since_ > 10 || (since_ == 1 && !far()))
        kick_ = Kick::lost;
    }
    now_ = {};
    correction_ = component_ = {};
  }
  /// Is the next correction to be a kick?
  [[nodiscard]] bool kicks() const { return kick_ == Kick::next; }
  [[nodiscard]] bool kicked() const { return kick_ == Kick::next || kick_ == Kick::back; }
  [[nodiscard]] bool returned() const { return kick_ == Kick::returned; }
  [[nodiscard]] bool lost() const { return kick_ == Kick::lost; }

  /// What the next correction is multiplied by. It is negative, since a correction that is too large by half
  /// would otherwise lead past a solution that is near.
  static constexpr int kick_factor = -65536;

 private:
  enum class Kick { none, next, back, returned, lost, vain };
  struct Sizes {
    Number own{0}, largest{0};  // of corrections, relative to their own and to the largest component
  };
  [[nodiscard]] bool far() const {
    return now_.own > Number(256) * most_.own || now_.largest > Number(256) * most_.largest;
  }

  Largest<T> correction_, component_;
  Sizes now_, most_;
  Kick kick_ = Kick::none;
  int since_ = 0;
};

}  // namespace pfaff
