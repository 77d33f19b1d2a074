// Conformal splitting for q' = T_p(p), p' = -V_q(q, t) - nu p:
//
//   step(h) = D(h/2) S(h) D(h/2),   D(h): p -> e^{-nu h} p,   S: Stoermer-Verlet for T + V
//
// (mclachlan-perlmutter2001; bhatt2016). D is the flow of the friction and S is symplectic, so that
// M^T J M = e^{-nu h} J: the canonical structure decays as along the flow, and K = e^{nu t} [[0, -I], [I, 0]]
// is kept, exactly and for every step. Explicit, symmetric, order 2; of higher order as a composition
// (composition.hpp), since D is defined for steps of either sign.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/splitting.hpp>

namespace pfaff {

/// The problem P without its friction: what is left is separable. Refers to P.
template <class P>
class Undamped {
 public:
  using Scalar = pfaff::Scalar<P>;
  using State = pfaff::State<P>;
  static constexpr int extent = P::extent;

  explicit Undamped(const P& problem) : problem_(problem) {}

  [[nodiscard]] std::size_t size() const { return problem_.size(); }
  [[nodiscard]] State make_state() const { return problem_.make_state(); }
  [[nodiscard]] decltype(auto) counters() const { return problem_.counters(); }
  /// -dV/dq.
  void force(const Scalar& t, In<Scalar> q, Out<Scalar> f) const requires HasConformal<P> {
    problem_.undamped_force(t, q, f);
  }
  /// dT/dp.
  void velocity(const Scalar& t, In<Scalar> p, Out<Scalar> v) const requires HasConformal<P> {
    problem_.undamped_velocity(t, p, v);
  }

 private:
  const P& problem_;
};

/// e^x - 1 to round-off, for x of any size.
template <class T>
T exp_minus_one(const T& x) {
  const T u = exp(x);
  // The rounding error of u cancels between u - 1 and log u.
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
