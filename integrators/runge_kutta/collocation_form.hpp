// The ways in which a collocation method makes its steps on a problem: as equations of first order
// (first_order_form.hpp) or, where the energy allows it, of second order (nystrom_form.hpp), for a number of
// stages that the compiler knows or for any. Which one it is shows when a method meets a problem; behind this
// interface a step costs one virtual call.
#pragma once

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/problem.hpp>

namespace pfaff {

/// Makes the steps of one collocation method on one problem of type P, and keeps what belongs to them.
template <class P>
class CollocationForm {
 public:
  using T = Scalar<P>;
  using Number = Value<T>;
  CollocationForm() = default;
  CollocationForm(const CollocationForm&) = delete;
  CollocationForm& operator=(const CollocationForm&) = delete;
  virtual ~CollocationForm() = default;

  /// A step of size h from (t, z), in place; z is left as it was where the step fails.
  virtual Status step(const P& p, const T& t, const T& h, State<P>& z, bool compensated) = 0;
  /// Forgets the past, round-off included: the next step depends on its state alone.
  virtual void restart() = 0;
  /// Where forms of the same kind take turns: gives `next` what sums have rounded off of the state.
  virtual void hand_over(CollocationForm& next) = 0;

 protected:
  /// What a fixed-point iteration or, where it has come to nothing, Newton's has ended with. Iterates of a
  /// stiff motion may leave the range of numbers before they are seen to diverge, as those of a motion that
  /// leaves it do, too: these are told apart by whether Newton's converge.
  template <class Newton>
  static Status or_by_newton(Status status, const Newton& newton) {
    if (status != Status::not_converged && status != Status::non_finite) return status;
    const Status by_newton = newton();
    return by_newton != Status::converged && status == Status::non_finite ? status : by_newton;
  }
};

/// Whether a form makes the Jacobian of the field and Newton's matrix at once, so that no step allocates.
/// They grow with the square of the number of coordinates, and most runs need none: forms for larger systems
/// make them when a step asks for the first time.
template <class P>
bool prepares_newton(const P& p) {
  return p.size() <= 128;
}

}  // namespace pfaff
