// Conformal splitting for q' = T_p(p, t), p' = -V_q(q, t) - nu p:
//
//   step(h) = D(h/2) S(h) D(h/2),   D(h): p -> e^{-nu h} p,   S: Stoermer-Verlet for T + V
//
// (mclachlan-perlmutter2001; bhatt2016). D is the flow of the friction and S is symplectic, so that the
// Jacobian M of a step satisfies M^T J M = e^{-nu h} J. The canonical structure thus decays as along the
// exact flow, and K = e^{nu t} [[0, -I], [I, 0]] is kept exactly by steps of any size. The method is
// explicit, symmetric and of order 2. Since D is defined for steps of either sign, compositions
// (composition.hpp) give methods of higher order.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/splitting/splitting.hpp>
#include <pfaff/integrators/support/problem_view.hpp>

namespace pfaff {

/// The problem P without its friction: what is left is separable. Refers to P.
template <class P>
class Undamped : public ProblemView<P> {
 public:
  using typename ProblemView<P>::Scalar;
  using ProblemView<P>::ProblemView;

  /// -dV/dq.
  void force(const Scalar& t, In<Scalar> q, Out<Scalar> f) const requires HasConformal<P> {
    this->problem().undamped_force(t, q, f);
  }
  /// dT/dp.
  void velocity(const Scalar& t, In<Scalar> p, Out<Scalar> v) const requires HasConformal<P> {
    this->problem().undamped_velocity(t, p, v);
  }
};

/// e^x - 1 to round-off, for x of any size.
template <class T>
T exp_minus_one(const T& x) {
  const T u = exp(x);
  // u is rounded, but u - 1 and log u are taken of the same rounded u, so that the error cancels in their
  // quotient.
  return value_of(u) == Value<T>(1) ? x : (u - T(1)) * x / log(u);
}

/// The splitting of order 2.
struct ConformalSplitting : Verlet {
  template <class P>
  struct Work {
    using T = Scalar<P>;
    pfaff::Work<Verlet, Undamped<P>> inner;  // shares its compensation with the damping
    T decay{0}, last_h{0};                   // e^{-nu h/2} - 1 for the last step
    bool known = false;
    Work(const ConformalSplitting& method, const P& p) : inner(method, Undamped<P>(p)) {}
  };

  template <HasConformal P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (!w.known || value_of(h) != value_of(w.last_h)) {
      w.decay = exp_minus_one(T(-(p.damping() * h / T(2))));
      w.last_h = h;
      w.known = true;
    }
    damp(z, w);
    const Status status = Verlet::step(Undamped<P>(p), t, h, z, w.inner);
    damp(z, w);
    return status;
  }

 private:
  template <class State, class W>
  void damp(State& z, W& w) const {
    for (std::size_t k = z.size() / 2; k < z.size(); ++k)
      add_to(z[k], w.inner.carry[k], w.decay * z[k], compensated);
  }
};

}  // namespace pfaff
