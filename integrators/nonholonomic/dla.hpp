// DLA, the discrete Lagrange-d'Alembert method with the discrete Lagrangian at the middle of a step, for
// H(q, p, t) with constraints psi(q, p, t) = A(q, t) v + b(q, t) = 0 of the velocities v = H_p:
//
//   pm = p0 + h/2 (-H_q(qm, pm)) - A(q0)^T lambda,  qm = q0 + h/2 H_p(qm, pm),  psi(qm, pm, t + h/2) = 0
//   q1 = qm + h/2 H_p(qm, pm),   p1 = pm + h/2 (-H_q(qm, pm)) - A(q1)^T mu,     psi(q1, p1, t1) = 0
//
// (cortes-martinez2001; with L_d(q0, q1) = h L((q0 + q1)/2, (q1 - q0)/h) the first line is -D1 L_d = p0 -
// A(q0)^T lambda, and the second D2 L_d before it is projected). The method as it is published carries the
// momentum p^- = D2 L_d without the projection. But a part A(q0)^T x of p0 only changes lambda, so that the
// positions are the same whether p^- or its projection is carried. Here the state is the projected momentum:
// a step is a map of the surface psi = 0 to itself, and goes on without a history.
//
// Order 2. Symmetric, because both halves of the step are the same seen from either end, and so reversible;
// psi = 0 holds to round-off. Compositions reach every order. The energy is not kept, nor any symplectic
// structure, which nonholonomic motion itself does not keep. Momenta along symmetries that the constraints
// allow are kept where these are linear in q. The update is compensated.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>
#include <pfaff/integrators/nonholonomic/middle_point.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace pfaff {

/// From the surface to the middle of the step and from there back to the surface.
struct DiscreteLagrangeDAlembert {
  /// The ways from the start to the middle and from there to the end, in units of the step.
  std::array<Quad, 2> halves{Quad(1) / Quad(2), Quad(1) / Quad(2)};
  bool compensated = true;

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  static std::vector<Parameter> parameters() {
    return {parameter(&DiscreteLagrangeDAlembert::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return halves; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T first, second;       // the halves
    std::vector<T> carry;  // what the sums of q and p have rounded off
    std::vector<T> displacement, impulse, position, momentum;
    MiddlePoint<T> middle;
    MomentumProjection<T> onto_velocities;
    Continuation<P> continuation;  // the state at which the constraints are placed
    bool linear;                   // H_p is linear in p

    Work(const DiscreteLagrangeDAlembert& method, const P& p)
        : first(Real(method.halves[0])),
          second(Real(method.halves[1])),
          carry(p.size()),
          displacement(n()),
          impulse(n()),
          position(n()),
          momentum(n()),
          middle(p.model(), p.nonholonomic().count()),
          onto_velocities(p.nonholonomic()),
          continuation(p) {
      linear = velocity_is_linear<T>(p.nonholonomic(), generic_time<T>(), generic_positions<T>(n()));
    }
    [[nodiscard]] std::size_t n() const { return carry.size() / 2; }
    /// Forgets the past, round-off included: the next step depends on its state alone.
    void restart() {
      forget();
      for (T& x : carry) x = T(0);
    }
    void forget() {
      middle.forget();
      continuation.forget();
    }
    /// The step that follows is taken with `next`.
    void hand_over(Work& next) {
      if (this == &next) return;
      std::swap(carry, next.carry);
      std::swap(continuation, next.continuation);
      continuation.forget();
    }
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    VelocityConstraints<T>& c = p.nonholonomic();
    const std::size_t n = w.n();
    const In<T> q0(z.data(), n), p0(z.data() + n, n), q_carry(w.carry.data(), n),
        p_carry(w.carry.data() + n, n);
    const T first = w.first * h, second = w.second * h;
    Status status = Status::converged;
    if (!w.continuation.holds_at(t, h, z)) {
      ++p.counters().factorisations;
      status = c.linearise(t, q0, p0);
    }
    if (status == Status::converged) status = w.middle.solve(p, c, t, h, first, q0, q_carry, p0, p_carry);
    if (status == Status::converged) {
      for (std::size_t k = 0; k < n; ++k) {
        w.displacement[k] = (first + second) * w.middle.velocity()[k];
        w.impulse[k] = first * (w.middle.force()[k] - w.middle.reaction()[k]) + second * w.middle.force()[k];
        w.position[k] = q0[k] + (w.displacement[k] + q_carry[k]);
        w.momentum[k] = p0[k] + (w.impulse[k] + p_carry[k]);
      }
      ++p.counters().factorisations;
      status = c.linearise(t + h, w.position, w.momentum);
    }
    if (status == Status::converged)
      status = w.onto_velocities(c, t + h, w.position, p0, p_carry, w.impulse, w.momentum, w.linear);
    if (status != Status::converged) {
      w.forget();
      return status;
    }
    for (std::size_t k = 0; k < n; ++k) {
      add_to(z[k], w.carry[k], w.displacement[k], compensated);
      add_to(z[n + k], w.carry[n + k], w.impulse[k], compensated);
    }
    w.middle.remember(h);
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

}  // namespace pfaff
