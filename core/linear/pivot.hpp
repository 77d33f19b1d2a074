// What an elimination without row exchanges does with its pivots. RegularPivots divides by every one and
// notes when one cannot be divided by; SemidefinitePivots leaves out those that are zero to round-off.
#pragma once

#include <cstddef>
#include <limits>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/pack.hpp>

namespace pfaff::detail {

/// True for scalars whose numbers can be inspected. A formula that is being recorded has none yet.
template <class T>
inline constexpr bool has_numbers = std::numeric_limits<Value<T>>::is_specialized;
template <int W>
inline constexpr bool has_numbers<Pack<W>> = true;

template <class T>
inline constexpr bool is_pack = false;
template <int W>
inline constexpr bool is_pack<Pack<W>> = true;

/// True where x is neither zero nor infinite nor not-a-number.
template <class T>
bool is_usable(const T& x) {
  const Value<T> number = value_of(x);
  return isfinite(number) && !(number == Value<T>(0));
}
template <int W>
bool is_usable(const Pack<W>& x) {
  bool usable = true;
  for (std::size_t lane = 0; lane < W; ++lane) usable = usable && is_usable(x[lane]);
  return usable;
}

/// Every pivot must be usable.
template <class T>
class RegularPivots {
 public:
  static constexpr bool follow_errors = false;
  /// 1 / pivot.
  T reciprocal(const T& pivot, const T& /*error*/) {
    if constexpr (!has_numbers<T>) {
      return T(1) / pivot;
    } else if constexpr (std::numeric_limits<Value<T>>::is_exact) {
      usable_ = usable_ && is_usable(pivot);
      return usable_ ? T(1) / pivot : T(0);
    } else {
      // It is enough to test the reciprocal, which is 0 or infinite where the pivot is infinite, zero or
      // too small.
      T r = T(1) / pivot;
      usable_ = usable_ & is_usable(r);
      return r;
    }
  }
  [[nodiscard]] bool usable() const { return usable_; }

 private:
  bool usable_ = true;
};

/// Pivots of a semidefinite matrix. A pivot no larger than its own round-off belongs to a direction outside
/// the matrix's range. It is replaced by infinity: its reciprocal, and with it the unknown of its row,
/// becomes 0.
///
/// The elimination keeps a bound of the error of every pivot, in units of round-off. The bound of pivot i
/// starts at a_ii, for forming the entry and for subtracting from it what never exceeds it. Eliminating row
/// k from row i adds l_ik^2 times the error of pivot k. Where pivots shrink along a chain, the errors that
/// come down from its first rows are many times those that arise in its last rows, so that a pivot cannot
/// be judged by its own a_ii alone.
template <class T>
class SemidefinitePivots {
 public:
  static constexpr bool follow_errors = true;
  /// 1 / pivot, or 0 for a pivot that is dropped.
  T reciprocal(const T& pivot, const T& error) {
    // If adding pivot / 64 does not change the error bound, the pivot is no larger than some units of
    // round-off, in whatever precision it is computed. The factor is 64 because the entries were computed,
    // too: each is an inner product of three or four terms, and l_ik passes the errors of couplings on
    // twice.
    const T visible = (error + pivot / T(64)) - error;
    const T safe = select(visible, pivot, T(1));
    T r = select(visible, T(1) / safe, T(0));
    if constexpr (has_numbers<T>) {
      note(r, visible);
    }
    return r;
  }
  /// False where a pivot was not a number.
  [[nodiscard]] bool usable() const { return usable_; }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }

 private:
  template <class N>
  void note(const N& r, const N& visible) {
    const Value<N> size = value_of(visible);
    usable_ = usable_ && isfinite(size) && isfinite(value_of(r));
    if (!(size > Value<N>(0))) ++dropped_;
  }
  template <int W>
  void note(const Pack<W>& r, const Pack<W>& visible) {
    for (std::size_t lane = 0; lane < W; ++lane) note(r[lane], visible[lane]);
  }
  bool usable_ = true;
  std::size_t dropped_ = 0;
};

}  // namespace pfaff::detail
