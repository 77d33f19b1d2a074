// Pfaff's methods as steppers of Boost.Odeint: any method that needs a vector field only models its Stepper
// concept.
//
//   OdeintStepper<MyMethod, std::vector<double>> stepper{MyMethod{}};
//   boost::numeric::odeint::integrate_const(stepper, system, x, t0, t1, h);
//
// What a method keeps from step to step, history and compensation, is kept while steps follow one another:
// each begins at the state and the time at which the last one ended, with the same dt and a system of the
// same type. Any other step starts anew, and so does a copy of a stepper; odeint's integrate functions copy
// the stepper once, when they begin. integrate_times and integrate_adaptive shorten steps to hit output
// times, which spoils what fixed steps preserve: use integrate_const or integrate_n_steps. A caller who
// changes the parameters of a system between steps calls reset().
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>
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

  FunctionProblem(System& system, const X& example) : system_(&system), x_(example), rate_(example) {}
  /// The function to call from now on.
  void use(System& system) { system_ = &system; }

  [[nodiscard]] std::size_t size() const { return x_.size(); }
  [[nodiscard]] State make_state() const { return State(x_.size()); }
  [[nodiscard]] Counters& counters() const { return counters_; }
  void field(const Scalar& t, In<Scalar> z, Out<Scalar> rate) const {
    std::copy(z.begin(), z.end(), x_.begin());
    (*system_)(x_, rate_, t);
    std::copy(rate_.begin(), rate_.end(), rate.begin());
  }

 private:
  System* system_;
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

  OdeintStepper(const OdeintStepper& other) : method_(other.method_), order_(other.order_) {}
  OdeintStepper(OdeintStepper&& other) noexcept = default;
  OdeintStepper& operator=(OdeintStepper other) noexcept {
    method_ = std::move(other.method_);
    order_ = other.order_;
    kept_ = std::move(other.kept_);
    return *this;
  }
  ~OdeintStepper() = default;

  [[nodiscard]] order_type order() const { return order_; }

  /// Forgets what the method has kept of earlier steps.
  void reset() { kept_.reset(); }

  /// One step of size dt from x at t, in place.
  template <class System>
  void do_step(System system, X& x, time_type t, time_type dt) {
    using P = FunctionProblem<System, X>;
    static_assert(Steps<M, P>,
                  "this method needs more than a vector field; use it through a system of Pfaff's");
    if (kept_ == nullptr || !kept_->leads_to(typeid(System), x, t, dt))
      kept_ = std::make_unique<KeptFor<System>>(method_, system, x);
    auto& kept = static_cast<KeptFor<System>&>(*kept_);
    kept.problem.use(system);
    std::copy(x.begin(), x.end(), kept.z.begin());
    const Status status = kept.method.step(kept.problem, t, dt, kept.z, kept.work);
    if (status != Status::converged) {
      reset();
      throw std::runtime_error("step at t = " + std::to_string(t) + ": " + std::string(to_string(status)));
    }
    std::copy(kept.z.begin(), kept.z.end(), x.begin());
    kept.end = x;
    kept.end_time = t + dt;
    kept.dt = dt;
  }

 private:
  // What is kept from one step to the next: the workspace of the method, and where the last step ended.
  struct Kept {
    const std::type_info* system;
    X end;
    time_type end_time{}, dt{};
    Kept(const std::type_info& type, const X& x) : system(&type), end(x) {}
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;
    virtual ~Kept() = default;
    // Times are t0 + n dt, and so agree to round-off only.
    [[nodiscard]] bool leads_to(const std::type_info& type, const X& x, time_type t, time_type step) const {
      using std::abs;
      return *system == type && step == dt && abs(t - end_time) <= abs(dt) * time_type(1e-6) && x == end;
    }
  };
  template <class System>
  struct KeptFor final : Kept {
    using P = FunctionProblem<System, X>;
    M method;
    P problem;
    typename P::State z;
    Work<M, P> work;
    KeptFor(const M& m, System& function, const X& x)
        : Kept(typeid(System), x),
          method(m),
          problem(function, x),
          z(problem.make_state()),
          work(method, problem) {}
  };

  M method_;
  order_type order_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace pfaff
