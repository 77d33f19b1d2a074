// Continuation: does this step begin where the last one ended?
//
// Methods that carry more than the state from step to step (the state in other coordinates, the state before)
// may do so only while nobody else has touched the state, the time or the step.
#pragma once

#include <cstddef>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// Equal numbers, with equal derivatives where they have any.
template <class T>
bool identical(const T& a, const T& b) {
  return value_of(a) == value_of(b);
}
template <class T, int N>
bool identical(const Dual<T, N>& a, const Dual<T, N>& b) {
  for (std::size_t k = 0; k < N; ++k)
    if (!identical(a.derivative[k], b.derivative[k])) return false;
  return identical(a.value, b.value);
}

/// Where the last step on a problem of type P ended.
template <class P>
class Continuation {
 public:
  using T = Scalar<P>;
  explicit Continuation(const P& p) : z_(p.make_state()) {}

  /// True when a step of size h from (t, z) goes on where the last one, of the same size, ended. Times are
  /// t0 + n h, and so agree to round-off only.
  [[nodiscard]] bool holds(const T& t, const T& h, const State<P>& z) const {
    return known_ && identical(h, h_) && holds_at(t, h, z);
  }
  /// The same for a step whose size h may be another one.
  [[nodiscard]] bool holds_at(const T& t, const T& h, const State<P>& z) const {
    if (!known_) return false;
    if (abs(value_of(t - t_)) > abs(value_of(h)) * Value<T>(1e-6)) return false;
    bool same = true;  // no early exit from the loop, so that comparisons are made side by side
    for (std::size_t k = 0; k < z_.size(); ++k) same = identical(z[k], z_[k]) && same;
    return same;
  }
  /// A step of size h ended at (t, z).
  void remember(const T& t, const T& h, const State<P>& z) {
    for (std::size_t k = 0; k < z_.size(); ++k) z_[k] = z[k];
    t_ = t;
    h_ = h;
    known_ = true;
  }
  void forget() { known_ = false; }

 private:
  State<P> z_;
  T t_{0}, h_{0};
  bool known_ = false;
};

}  // namespace pfaff
