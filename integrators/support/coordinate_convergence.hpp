// Convergence of iterations that correct positions or momenta as vectors, in any units of their coordinates.
//
// Positions on a constraint surface are corrected along the constraints' gradients, and a coordinate may be
// zero while its correction is not. Corrections are therefore judged by their largest, against the largest
// coordinate, derivative parts of duals by themselves; how they converge is for Convergence or
// SettlingConvergence to tell. Two things this cannot see:
//
//   Small coordinates, above all those in units of their own. Where one that is corrected is less than
//     1/512 of the largest, an iteration that has converged goes on until each correction is at round-off of
//     its own coordinate, or none of them becomes half as large any more. The size of a coordinate is that of
//     its value, or of 32 times its change over the step where it passes through zero. Derivatives of a
//     coordinate are taken in this size for unit, and each direction is judged by itself.
//   Rounding far above round-off of the coordinates, as of constants in phi: the radius of a circle whose
//     lowest point is the origin. There corrections become no smaller, as they do where an iteration does not
//     contract. An iteration that stagnates is therefore kicked away from where it is, by 16384 times its
//     next correction. It has converged where it comes back by itself in ten iterations: what contracts in
//     the large would contract in the small, were it not for rounding.
//
// Refused although sound: rounding above 2^-20 of the largest coordinate, as at rest near the origin, and
// constraints that bend within 16384 times their rounding. Accepted although unsound: corrections of a small
// coordinate that do not contract where those of the largest have converged; three digits less for
// coordinates that are not small enough; and what stagnates at a kink that is less than 2^-20 of the largest
// coordinate wide, in a constraint that is straight far beyond it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/support/largest.hpp>

namespace pfaff {

namespace detail {
/// The largest |x| / size, sizes being positive or zero, and the least size of what is not zero.
template <class T>
class LargestRatio {
 public:
  void add(const T& x, const T& size) {
    if (x == T(0)) return;
    ratio_ = std::max(ratio_, size > T(0) ? T(abs(x) / size) : std::numeric_limits<T>::infinity());
    least_ = std::min(least_, size);
  }
  [[nodiscard]] T get() const { return ratio_; }
  [[nodiscard]] T least() const { return least_; }

 private:
  T ratio_{0}, least_ = std::numeric_limits<T>::infinity();
};
/// The bits of doubles are nearly in proportion to their logarithms, so that differences of bits are ratios
/// to an eighth. Sizes of zero are taken for the smallest normal number.
template <>
class LargestRatio<double> {
 public:
  void add(double x, double size) {
    const std::int64_t of = std::bit_cast<std::int64_t>(abs(x)),
                       to = std::max(smallest, std::bit_cast<std::int64_t>(size));
    log_ = std::max(log_, of - to);
    least_ = std::min(least_, of == 0 ? infinity : to);
  }
  [[nodiscard]] double get() const {
    constexpr auto one = std::bit_cast<std::int64_t>(1.0);
    return std::bit_cast<double>(std::clamp(log_, -one, infinity - one) + one);
  }
  [[nodiscard]] double least() const { return std::bit_cast<double>(least_); }

 private:
  static constexpr auto infinity = std::bit_cast<std::int64_t>(std::numeric_limits<double>::infinity()),
                        smallest = std::bit_cast<std::int64_t>(std::numeric_limits<double>::min());
  std::int64_t log_ = std::numeric_limits<std::int64_t>::min(), least_ = infinity;
};

/// The size of a coordinate, see the opening comment.
template <class T>
T own_size(const T& value, const T& change) {
  return std::max(T(abs(value)), T(abs(T(32) * change)));
}

/// The largest correction, each relative to the size of its own coordinate, and the size of the smallest
/// coordinate that is corrected.
template <class T>
class OwnCorrections {
 public:
  void add(const T& correction, const T& value, const T& change) {
    largest_.add(correction, own_size(value, change));
  }
  [[nodiscard]] T get() const { return largest_.get(); }
  [[nodiscard]] T least() const { return largest_.least(); }

 private:
  LargestRatio<T> largest_;
};
template <class T, int N>
class OwnCorrections<Dual<T, N>> {
 public:
  void add(const Dual<T, N>& correction, const Dual<T, N>& value, const Dual<T, N>& change) {
    values_.add(correction.value, value.value, change.value);
    const Value<T> unit = own_size<Value<T>>(value_of(value), value_of(change));
    if (unit == Value<T>(0)) return;  // the units of such a coordinate are not known
    for (std::size_t k = 0; k < N; ++k) {
      corrections_[k].add(value_of(correction.derivative[k]), unit);
      sizes_[k].add(value_of(value.derivative[k]), unit);
      sizes_[k].add(value_of(change.derivative[k]), unit);
    }
  }
  [[nodiscard]] Value<T> get() const {
    LargestRatio<Value<T>> largest;
    for (std::size_t k = 0; k < N; ++k) largest.add(corrections_[k].get(), sizes_[k].get());
    return std::max(Value<T>(values_.get()), largest.get());
  }
  [[nodiscard]] Value<T> least() const { return values_.least(); }

 private:
  OwnCorrections<T> values_;
  std::array<LargestRatio<Value<T>>, static_cast<std::size_t>(N)> corrections_, sizes_;
};
}  // namespace detail

/// The corrections of one vector in one iteration, and what they are judged against.
template <class T>
class VectorCorrections {
 public:
  /// `each`: whether corrections are judged by their own coordinates, too (CoordinateConvergence::each).
  explicit VectorCorrections(bool each) : each_(each) {}

  /// A number of the vector, or one of its changes.
  void against(const T& x) { reference_.add(x); }
  /// One whose derivatives alone are counted.
  void against_derivatives(T x) {
    if constexpr (!std::is_same_v<T, Value<T>>) {
      x.value = {};
      reference_.add(x);
    }
  }
  /// The correction of a coordinate, its value and its change over the step.
  void add(const T& correction, const T& value, const T& change) {
    correction_.add(correction);
    if (each_) own_.add(correction, value, change);
  }
  /// Begins another iteration for the same vector, which has moved as far as it was corrected.
  void next(bool each) {
    each_ = each;
    reference_.add(correction_.get());
    correction_ = {};
    own_ = {};
  }
  /// The largest correction, relative to the largest number of the vector.
  [[nodiscard]] Value<T> relative() const {
    const T reference = reference_.get();
    return relative_size(correction_.get(), reference, reference);
  }
  /// The largest of the corrections that are each relative to their own coordinate.
  [[nodiscard]] Value<T> own() const { return own_.get(); }
  /// True where a coordinate that is corrected is too small to be judged by the largest.
  [[nodiscard]] bool unlike() const {
    return abs(value_of(reference_.get())) > Value<T>(least_ratio) * own_.least();
  }

 private:
  static constexpr int least_ratio = 512;
  Largest<T> correction_, reference_;
  detail::OwnCorrections<T> own_;
  bool each_;
};

/// Watches the corrections of one iteration; `Watch` is how they converge, Convergence or
/// SettlingConvergence.
template <class T, class Watch = Convergence<T>>
class CoordinateConvergence {
 public:
  using Number = Value<T>;

  explicit CoordinateConvergence(Corrections corrections = Corrections::even)
      : watch_(corrections), corrections_(corrections) {}

  /// Whether the next iteration needs corrections judged by their own coordinates: the first one that tells
  /// something does, to see whether any are small, and those after it only where some are.
  [[nodiscard]] bool each() const { return unlike_ || watch_.iterations() == untold(); }
  /// Call before the corrections of an iteration are added.
  void begin_iteration() {
    if (!kicked()) watch_.begin_iteration();
    previous_ = own_;
    size_ = own_ = Number(0);
  }
  void add(const VectorCorrections<T>& corrections) {
    const Number size = corrections.relative(), own = corrections.own();
    if (!kicked()) watch_.add(T(size), T(1), T(1));
    unlike_ = unlike_ || corrections.unlike();
    if (size > size_ || isnan(size)) size_ = size;
    own_ = std::max(own_, own);
  }
  /// Says that there is nothing to gain, as the caller knows for a reason of its own.
  void settle() { settled_ = true; }
  /// True when the iteration should stop; `status()` then says how. `known` are the contractions that the
  /// watch takes.
  template <class... Known>
  bool finished(int limit, const Known&... known) {
    if (!kicked() && !converged_) {
      const bool over = watch_.finished(limit, known...);
      if (over && watch_.status() != Status::converged) return true;
      converged_ = settled_ || (over && watch_.iterations() > untold());
    }
    if (!converged_ && (kicked() || watch_.iterations() > 6)) converged_ = returned();
    return isnan(size_) || (converged_ ? !(unlike_ && goes_on()) : kick_ == Kick::lost);
  }
  /// `floor`: what corrections by their own coordinates came to in an earlier iteration like this one, where
  /// rounding lets them become no smaller; 0 where that is not known. With it none is made in vain to see it
  /// again. `contraction`: an upper bound for the second correction over the first; 1 where none is known.
  void expect(const Number& floor, const Number& contraction) { floor_ = floor, expected_ = contraction; }
  /// What they came to in this one; 0 where that was not seen, or is more than three digits, since that of a
  /// coordinate that is nearly zero says nothing of the others.
  [[nodiscard]] Number floor() const {
    const bool seen = own_idle_ >= most_idle && smallest_own_ <= Number(4096) * unit_roundoff<T>();
    return seen ? smallest_own_ : Number(0);
  }
  /// Multiplies what the next correction is made of: it is a kick where the iteration stagnates.
  void kick(Out<T> next) const {
    if (kick_ == Kick::next)
      for (T& x : next) x = T(-kick_size) * x;
  }

  /// The largest correction of the last iteration, relative to the largest coordinate.
  [[nodiscard]] const Number& size() const { return size_; }
  [[nodiscard]] Number ratio() const { return watch_.ratio(); }
  [[nodiscard]] Number contraction() const { return watch_.contraction(); }
  [[nodiscard]] int iterations() const { return watch_.iterations(); }
  [[nodiscard]] Status status() const {
    if (isnan(size_)) return Status::non_finite;
    return converged_ ? Status::converged : watch_.status();
  }

 private:
  static constexpr int most_idle = 2;  // corrections in a row that are not half as large as any before
  static constexpr int kick_size = 16384, far_size = 256, largest_over_rounding = 1 << 20;
  enum class Kick { none, next, back, lost };
  [[nodiscard]] bool kicked() const { return kick_ == Kick::next || kick_ == Kick::back; }

  // How many of the first corrections tell nothing. Where one unknown lags an iteration behind another the
  // first may be zero, and a large one follow.
  [[nodiscard]] int untold() const { return corrections_ == Corrections::in_turns ? 1 : 0; }
  // Finds where an iteration stagnates, kicks it, and returns true once it has come back.
  bool returned() {
    const bool far = size_ > Number(far_size) * stagnant_;
    if (kick_ == Kick::next) {  // in vain where what stagnates is not what was kicked
      kick_ = far ? Kick::back : Kick::none;
      idle_ = 0;
    } else if (kick_ == Kick::back) {
      if (idle_ > 0 && size_ <= Number(4) * stagnant_) return true;
      if (++idle_ > 10 || (idle_ == 1 && !far)) kick_ = Kick::lost;
    } else {
      const bool falls = size_ < smallest_ * Number(0.9375);
      idle_ = falls ? 0 : idle_ + 1;
      stagnant_ = idle_ < 2 ? size_ : std::max(stagnant_, size_);
      if (falls) smallest_ = size_;
      // So near to round-off the watch takes it for rounding, too, unless it still falls in its last digits.
      if (idle_ >= 6 && stagnant_ <= Number(65536) * unit_roundoff<T>()) return true;
      if (idle_ >= 6 && Number(largest_over_rounding) * stagnant_ <= Number(1)) kick_ = Kick::next;
    }
    return false;
  }
  // Whether coordinates in unlike units are corrected by less and less, and have not come to round-off.
  bool goes_on() {
    const Number u = unit_roundoff<T>(), ratio = watch_.iterations() == 1 ? expected_ : own_ / previous_;
    const bool foretold = corrections_ == Corrections::even &&
                          own_ < std::numeric_limits<Number>::infinity() && ratio < Number(0.5) &&
                          ratio * own_ <= std::max(Number(u / Number(64)), floor_);
    own_idle_ = own_ < smallest_own_ / Number(2) ? 0 : own_idle_ + 1;
    smallest_own_ = std::min(smallest_own_, own_);
    const Number least = std::max(Number(u / Number(8)), Number(Number(4) * floor_));
    return own_ > least && !foretold && own_idle_ < most_idle && ++more_ <= 32;
  }

  Watch watch_;
  Corrections corrections_;
  Number size_{0}, own_{0}, previous_{0}, stagnant_{0}, floor_{0}, expected_{1};
  Number smallest_ = std::numeric_limits<Number>::infinity(), smallest_own_ = smallest_;
  int idle_ = 0, own_idle_ = 0, more_ = 0;
  Kick kick_ = Kick::none;
  bool converged_ = false, settled_ = false, unlike_ = false;
};

}  // namespace pfaff
