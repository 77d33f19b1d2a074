// Projection of a method's steps onto constraints psi(q, p, t) = A v + b = 0 of velocities v = H_p, where a
// formulation has made a vector field of the system.
//
// Momenta are moved along A^T, so that in the metric of the masses they move as little as can be. Positions
// are free. With the base method's step Phi_h there are two forms, as for holonomic constraints:
//   after the step (hairer-lubich-wanner2006 IV.4, algorithm 4.2): z1 is Phi_h(z0) projected;
//   symmetric (V.4.1): z1 = Phi_h(z0 + (0, A(q0)^T x)) + (0, A(q1)^T x).
// Both keep the order of the method. The first keeps the constraints and nothing else; the second is
// symmetric where the method is, and follows reversible systems without drift.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>

namespace pfaff {

/// Steps of Base, each followed by a projection of the momenta.
template <class Base>
struct VelocityProjected : Base {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    pfaff::Work<Base, P> base;
    State<P> end;
    std::vector<T> change, no_carry, moved;
    MomentumProjection<T> onto_velocities;

    Work(const VelocityProjected& method, const P& p)
        : base(method, p),
          end(p.make_state()),
          change(p.size() / 2),
          no_carry(change.size()),
          moved(change.size()),
          onto_velocities(p.nonholonomic()) {}
  };

  template <HasVelocityConstraints P>
  requires Steps<Base, P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                      Work<P>& w)
  const {
    using T = Scalar<P>;
    VelocityConstraints<T>& c = p.nonholonomic();
    const std::size_t n = w.change.size();
    std::copy(z.begin(), z.end(), w.end.begin());
    if (const Status status = Base::step(p, t, h, w.end, w.base); status != Status::converged) return status;
    const In<T> q(w.end.data(), n), momentum(w.end.data() + n, n);
    ++p.counters().factorisations;
    if (const Status status = c.linearise(t + h, q, momentum); status != Status::converged) return status;
    for (T& x : w.change) x = T(0);
    constexpr bool linear = false;  // a second solve removes what the first rounds off
    if (const Status status = w.onto_velocities(c, t + h, q, momentum, w.no_carry, w.change, w.moved, linear);
        status != Status::converged)
      return status;
    for (std::size_t k = 0; k < n; ++k) {
      z[k] = q[k];
      z[n + k] = momentum[k] + w.change[k];
    }
    return Status::converged;
  }
};

/// Steps of Base, projected symmetrically. The workspace of Base has to offer restart(): it is started afresh
/// in every iteration, so that the step depends on its state alone and not on the iterations before.
template <class Base>
struct SymmetricallyVelocityProjected : Base {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    pfaff::Work<Base, P> base;
    std::unique_ptr<VelocityConstraints<T>> at_start;  // placed at z0; problem.nonholonomic() is placed at z1
    State<P> start, end;
    std::vector<T> multiplier, residual, kick;

    Work(const SymmetricallyVelocityProjected& method, const P& p)
        : base(method, p),
          at_start(p.model()->template velocity_constraints<T>()),
          start(p.make_state()),
          end(p.make_state()),
          multiplier(p.nonholonomic().count()),
          residual(multiplier.size()),
          kick(p.size() / 2) {}

    /// Adds A^T x to the momenta of a state, with A of the point where the constraints `at` were placed.
    void shift(const VelocityConstraints<T>& at, State<P>& state) {
      at.apply_transpose(multiplier, kick);
      for (std::size_t k = 0; k < kick.size(); ++k) state[kick.size() + k] = state[kick.size() + k] + kick[k];
    }
  };

  template <HasVelocityConstraints P>
  requires Steps<Base, P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                      Work<P>& w)
  const {
    using T = Scalar<P>;
    VelocityConstraints<T>& c = p.nonholonomic();
    const std::size_t n = w.kick.size();
    const In<T> q(w.end.data(), n), momentum(w.end.data() + n, n);
    Status status = w.at_start->linearise(t, In<T>(z.data(), n), In<T>(z.data() + n, n));
    if (status == Status::converged) status = c.linearise(t, In<T>(z.data(), n), In<T>(z.data() + n, n));
    p.counters().factorisations += 2;
    constexpr bool in_turns = true;  // z1 and A(q1) are improved in turns: A(q1) is one iteration behind
    Convergence<T> convergence(in_turns);
    while (status == Status::converged) {
      std::copy(z.begin(), z.end(), w.start.begin());
      w.shift(*w.at_start, w.start);
      std::copy(w.start.begin(), w.start.end(), w.end.begin());
      w.base.restart();
      status = Base::step(p, t, h, w.end, w.base);
      if (status != Status::converged) break;
      ++p.counters().factorisations;
      status = c.linearise(t + h, q, momentum);
      if (status != Status::converged) break;
      w.shift(c, w.end);
      c.values(t + h, q, momentum, w.residual);
      c.solve(w.residual, w.residual);
      // The multipliers act at both ends of the step, so that half the correction at each is enough.
      for (std::size_t i = 0; i < w.residual.size(); ++i)
        w.multiplier[i] = w.multiplier[i] - w.residual[i] / T(2);
      c.apply_transpose(w.residual, w.kick);
      Largest<T> kicked, momenta;
      for (std::size_t k = 0; k < n; ++k) {
        kicked.add(w.kick[k]);
        momenta.add(momentum[k]);
      }
      convergence.begin_iteration();
      convergence.add(kicked.get(), momenta.get(), momenta.get());
      ++p.counters().iterations;
      if (convergence.finished(50)) {
        status = convergence.status() == Status::converged ? Status::converged : Status::not_converged;
        break;
      }
    }
    if (status != Status::converged) {
      for (T& x : w.multiplier) x = T(0);
      return status;
    }
    for (std::size_t k = 0; k < n; ++k) {  // w.end lacks the last correction, which is added here
      z[k] = w.end[k];
      z[n + k] = w.end[n + k] - w.kick[k];
    }
    return Status::converged;
  }
};

}  // namespace pfaff
