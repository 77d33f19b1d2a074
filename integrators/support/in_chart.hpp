// Methods for vector fields, run in Darboux coordinates.
//
// In the chart y = chart(t, z) the structure is constant and canonical, and the field is that of a
// Hamiltonian. A method that is symplectic for constant structure is therefore K(z,t)-symplectic when it
// steps y: with the chart's Jacobian Y_z, Y_z^T K_c Y_z = K (su-qin, after (33)), so that z -> z' keeps K(z,
// t) where the step y -> y' keeps K_c.
//
// Between steps the method goes on from y, with its compensation and history, and z is only computed from it.
// Where somebody has changed the state z since the last step, y is computed from z and the method restarts.
#pragma once

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/integrators/support/problem_view.hpp>

namespace pfaff {

/// The problem P as its Darboux chart shows it: states are y, the field is Y(y, t). Refers to P.
template <class P>
class InChart : public ProblemView<P> {
 public:
  using typename ProblemView<P>::Scalar;
  using ProblemView<P>::ProblemView;

  /// Makes the evaluator of the formula that stands for `formula` in the chart.
  void prepare(Formula formula) const { this->problem().prepare(in_chart(formula)); }
  /// The same for an evaluator at W points side by side.
  template <int W>
  [[nodiscard]] Evaluator<Pack<W>> in_lanes(Formula formula) const requires requires(const P& p) {
    p.template in_lanes<W>(formula);
  }
  { return this->problem().template in_lanes<W>(in_chart(formula)); }
  /// rate = Y(y, t).
  void field(const Scalar& t, In<Scalar> y, Out<Scalar> rate) const requires HasDarbouxChart<P> {
    this->problem().chart_field(t, y, rate);
  }
  /// The tape of Y.
  [[nodiscard]] std::shared_ptr<const Tape> field_tape() const requires HasDarbouxChart<P> {
    return this->problem().chart_field_tape();
  }
  /// matrix[i n + j] = dY_i / dy_j.
  void field_jacobian(const Scalar& t, In<Scalar> y, Out<Scalar> matrix) const requires HasDarbouxChart<P> {
    this->problem().chart_field_jacobian(t, y, matrix);
  }

 private:
  static constexpr Formula in_chart(Formula formula) {
    return formula == Formula::field            ? Formula::chart_field
           : formula == Formula::field_jacobian ? Formula::chart_field_jacobian
                                                : formula;
  }
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
    return moved(p, t, t + h, h, z, w,
                 [&](const InChart<P>& chart, State<P>& y) { return Base::step(chart, t, h, y, w.inner); });
  }

 protected:
  // Moves z, at time t, by `part` of a step in the chart, after which the time is `end`.
  template <class P, class Part>
  Status moved(const P& p, const Scalar<P>& t, const Scalar<P>& end, const Scalar<P>& h, State<P>& z,
               Work<P>& w, const Part& part) const {
    if (!w.continuation.holds(t, h, z)) {
      p.chart(t, z, w.y);
      w.inner.restart();
    }
    const Status status = part(InChart<P>(p), w.y);
    if (status != Status::converged) {
      w.continuation.forget();
      return status;
    }
    p.chart_inverse(end, w.y, z);
    w.continuation.remember(end, h, z);
    return Status::converged;
  }
};

/// The same for a base whose step has a processor, whose parts are taken in the chart too. What surrounds the
/// processor sees the chart at the time at which steps begin and end, so that the next part finds the same
/// point in it.
template <class Base>
struct ProcessedInDarbouxChart : InDarbouxChart<Base> {
  template <class P>
  using Work = typename InDarbouxChart<Base>::template Work<P>;

  template <HasDarbouxChart P>
  requires Steps<Base, InChart<P>> Status preprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h,
                                                     State<P>& z, Work<P>& w)
  const {
    return this->moved(p, t, t, h, z, w, [&](const InChart<P>& chart, State<P>& y) {
      return Base::preprocess(chart, t, h, y, w.inner);
    });
  }
  template <HasDarbouxChart P>
  requires Steps<Base, InChart<P>> Status kernel(const P& p, const Scalar<P>& t, const Scalar<P>& h,
                                                 State<P>& z, Work<P>& w)
  const {
    return this->moved(p, t, t + h, h, z, w, [&](const InChart<P>& chart, State<P>& y) {
      return Base::kernel(chart, t, h, y, w.inner);
    });
  }
  template <HasDarbouxChart P>
  requires Steps<Base, InChart<P>> Status postprocess(const P& p, const Scalar<P>& t, const Scalar<P>& h,
                                                      State<P>& z, Work<P>& w)
  const {
    return this->moved(p, t, t, h, z, w, [&](const InChart<P>& chart, State<P>& y) {
      return Base::postprocess(chart, t, h, y, w.inner);
    });
  }
};

}  // namespace pfaff
