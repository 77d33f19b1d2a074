// Whole right-hand sides of constrained motions as one operation, which evaluators of constraints may offer
// where they need fewer passes for it than their other operations together.
#pragma once

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The whole right-hand side, without friction, of the motion with one kind of reactions.
template <class T>
class ConstrainedRates {
 public:
  virtual ~ConstrainedRates() = default;
  /// q' and p' at (q, p, t). The call may overwrite whatever the constraints had placed before.
  virtual Status operator()(const T& t, In<T> q, In<T> p, Out<T> q_rate, Out<T> p_rate) = 0;
};

/// The motion of holonomic constraints with ideal reactions, q' = v and p' = -H_q - B^T x, for those who join
/// more constraints to them.
template <class T>
class IdealRates : public ConstrainedRates<T> {
 public:
  /// What the reactions leave of a force f on the momenta, rest = f - B^T S^-1 P f, where the rates were last
  /// computed; n numbers each.
  virtual void respond(In<T> f, Out<T> rest) = 0;
};

}  // namespace pfaff
