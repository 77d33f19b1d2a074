// Methods for vector fields, run in Darboux coordinates.
//
// In the chart y = chart(t, z) the structure is constant and canonical, and the field is that of a
// Hamiltonian, so a method that is symplectic for constant structure is K(z,t)-symplectic when it steps y:
// with Y_z^T K_c Y_z = K (su-qin, after (33)) and a step y -> y' that keeps K_c, z -> z' keeps K(z, t).
//
// Between steps the state stays in the chart, with its compensation and history; z is derived from it. A
// state that was changed from outside starts afresh.
#pragma once

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/integrators/continuation.hpp>

namespace pfaff {

/// The problem P as its Darboux chart shows it: states are y, the field is Y(y, t). Refers to P.
template <class P>
class InChart {
 public:
  using Scalar = pfaff::Scalar<P>;
  using State = pfaff::State<P>;
  static constexpr int extent = P::extent;

  explicit InChart(const P& problem) : problem_(problem) {}

  [[nodiscard]] std::size_t size() const { return problem_.size(); }
  [[nodiscard]] State make_state() const { return problem_.make_state(); }
  [[nodiscard]] decltype(auto) counters() const { return problem_.counters(); }
  /// Makes the evaluator of the formula that stands for `formula` in the chart.
  void prepare(Formula formula) const {
    problem_.prepare(formula == Formula::field            ? Formula::chart_field
                     : formula == Formula::field_jacobian ? Formula::chart_field_jacobian
                                                          : formula);
  }
  /// rate = Y(y, t).
  void field(const Scalar& t, In<Scalar> y, Out<Scalar> rate) const requires HasDarbouxChart<P> {
    problem_.chart_field(t, y, rate);
  }
  /// matrix[i n + j] = dY_i / dy_j.
  void field_jacobian(const Scalar& t, In<Scalar> y, Out<Scalar> matrix) const requires HasDarbouxChart<P> {
    problem_.chart_field_jacobian(t, y, matrix);
  }

 private:
  const P& problem_;
};

/// The method Base, whose workspace can restart(), in Darboux coordinates.
template <class Base>
struct InDarbouxChart : Base {
  template <class P>
  struct Work {
    pfaff::Work<Base, InChart<P>> inner;
    State<P> y;
    Continuation<P> continuation;

    Work(const InDarbouxChart& method, const P& p)
        : inner(method, InChart<P>(p)), y(p.make_state()), continuation(p) {
      for (const Formula formula : {Formula::chart, Formula::chart_inverse, Formula::chart_field})
        p.prepare(formula);
    }
  };

  template <HasDarbouxChart P>
  requires Steps<Base, InChart<P>> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h,
                                               State<P>& z, Work<P>& w)
  const {
    if (!w.continuation.holds(t, h, z)) {
      p.chart(t, z, w.y);
      w.inner.restart();
    }
    const Status status = Base::step(InChart<P>(p), t, h, w.y, w.inner);
    if (status != Status::converged) {
      w.continuation.forget();
      return status;
    }
    p.chart_inverse(t + h, w.y, z);
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

}  // namespace pfaff
