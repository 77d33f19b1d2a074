// Pfaff's methods as steppers of Boost.Odeint: any method that needs a vector field only models its Stepper
// concept.
//
//   OdeintStepper<MyMethod, std::vector<double>> stepper{MyMethod{}};
//   boost::numeric::odeint::integrate_const(stepper, system, x, t0, t1, h);
//
// Every step is a function of (t, x, dt) alone: odeint copies its steppers, and may change system, state or
// step between calls, so no history or compensation is carried from one step to the next. integrate_times and
// integrate_adaptive shorten steps to hit output times, which spoils what fixed steps preserve: use
// integrate_const or integrate_n_steps.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <boost/numeric/odeint/stepper/stepper_categories.hpp>

#include <pfaff/core/facets/advance.hpp>

namespace pfaff {

/// An odeint system function, system(x, dxdt, t), as a problem that offers a vector field and nothing else.
/// `X` is odeint's state type (std::vector or std::array of doubles).
template <class System, class X>
class FunctionProblem {
 public:
  using Scalar = typename X::value_type;
  using State = Vector<Scalar, dynamic>;
  static constexpr int extent = dynamic;

  FunctionProblem(System system, const X& example) : system_(system), x_(example), rate_(example) {}

  [[nodiscard]] std::size_t size() const { return x_.size(); }
  [[nodiscard]] State make_state() const { return State(x_.size()); }
  [[nodiscard]] Counters& counters() const { return counters_; }
  void field(const Scalar& t, In<Scalar> z, Out<Scalar> rate) const {
    std::copy(z.begin(), z.end(), x_.begin());
    system_(x_, rate_, t);
    std::copy(rate_.begin(), rate_.end(), rate.begin());
  }

 private:
  System system_;
  mutable X x_, rate_;
  mutable Counters counters_;
};

/// Method M as an odeint stepper of states X. A step that does not converge throws std::runtime_error:
/// odeint's concept has no status.
template <class M, class X = std::vector<double>>
class OdeintStepper {
 public:
  using state_type = X;
  using deriv_type = X;
  using value_type = typename X::value_type;
  using time_type = value_type;
  using order_type = unsigned short;
  using stepper_category = boost::numeric::odeint::stepper_tag;

  explicit OdeintStepper(M method, order_type order = 1) : method_(std::move(method)), order_(order) {}

  [[nodiscard]] order_type order() const { return order_; }

  /// One step of size dt from x at t, in place.
  template <class System>
  void do_step(System system, X& x, time_type t, time_type dt) {
    using P = FunctionProblem<System, X>;
    static_assert(Steps<M, P>,
                  "this method needs more than a vector field; use it through a system of Pfaff's");
    const P problem(system, x);
    Work<M, P> work(method_, problem);
    auto z = problem.make_state();
    std::copy(x.begin(), x.end(), z.begin());
    if (const Status status = method_.step(problem, t, dt, z, work); status != Status::converged)
      throw std::runtime_error("step at t = " + std::to_string(t) + ": " + std::string(to_string(status)));
    std::copy(z.begin(), z.end(), x.begin());
  }

 private:
  M method_;
  order_type order_;
};

}  // namespace pfaff
