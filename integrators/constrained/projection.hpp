// Projection of a method's steps onto the constraint surface phi = 0, phi~ = 0 of a formulated system.
//
// Positions are moved along H_pp B^T and momenta along B^T, so that the masses weigh the projection. With the
// base method's step Phi_h there are two forms:
//   after the step (hairer-lubich-wanner2006 IV.4, algorithm 4.2): z1 is Phi_h(z0) projected;
//   symmetric (V.4.1): z1 = Phi_h(z0 + D(z0) m) + D(z1) m with D m = (H_pp B^T x, B^T y), m = (x, y).
// Both keep the order of the method. The first keeps the constraints and nothing else; the second is
// symmetric where the method is, and follows time-reversible systems without drift. Neither is symplectic.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/facets/advance.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>

namespace pfaff {

/// Steps of Base, each followed by a projection.
template <class Base>
struct Projected : Base {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    pfaff::Work<Base, P> base;
    State<P> end;
    std::vector<T> residual, move, change, no_carry, moved;
    MomentumProjection<T> onto_hidden;

    Work(const Projected& method, const P& p)
        : base(method, p),
          end(p.make_state()),
          residual(p.holonomic().count()),
          move(p.size() / 2),
          change(move.size()),
          no_carry(move.size()),
          moved(move.size()),
          onto_hidden(p.holonomic()) {}
  };

  template <HasHolonomic P>
  requires Steps<Base, P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                      Work<P>& w)
  const {
    using T = Scalar<P>;
    PositionConstraints<T>& c = p.holonomic();
    const std::size_t n = w.move.size();
    std::copy(z.begin(), z.end(), w.end.begin());
    if (const Status status = Base::step(p, t, h, w.end, w.base); status != Status::converged) return status;
    const Out<T> q(w.end.data(), n), momentum(w.end.data() + n, n);
    if (const Status status = place(p, c, t + h, q, momentum); status != Status::converged) return status;
    Convergence<T> convergence;
    do {
      c.values(t + h, q, w.residual);
      c.solve(w.residual, w.residual);
      c.hidden_by_momentum_transpose(w.residual, w.move);
      Largest<T> correction, reference;
      for (std::size_t k = 0; k < n; ++k) {
        correction.add(w.move[k]);
        reference.add(q[k]);
        q[k] = q[k] - w.move[k];
      }
      convergence.begin_iteration();
      convergence.add(correction.get(), reference.get(), reference.get());
      ++p.counters().iterations;
    } while (!convergence.finished(50));
    if (convergence.status() != Status::converged) return Status::not_converged;
    if (const Status status = place(p, c, t + h, q, momentum); status != Status::converged) return status;
    for (T& x : w.change) x = T(0);
    if (const Status status = w.onto_hidden(c, t + h, q, momentum, w.no_carry, w.change, w.moved, false);
        status != Status::converged)
      return status;
    for (std::size_t k = 0; k < n; ++k) {
      z[k] = q[k];
      z[n + k] = momentum[k] + w.change[k];
    }
    return Status::converged;
  }

 private:
  template <class P, class T>
  static Status place(const P& p, PositionConstraints<T>& c, const T& t, In<T> q, In<T> momentum) {
    ++p.counters().factorisations;
    return c.linearise(t, q, momentum);
  }
};

/// Steps of Base, projected symmetrically. The workspace of Base has to offer restart(): it is started afresh
/// in every iteration, so that the step depends on its state alone and not on the iterations before.
template <class Base>
struct SymmetricallyProjected : Base {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    pfaff::Work<Base, P> base;
    std::unique_ptr<PositionConstraints<T>> at_start;  // placed at z0; problem.holonomic() is placed at z1
    State<P> start, end;
    std::vector<T> by_position, by_momentum;  // x, y
    std::vector<T> residual, rate, move, kick;

    Work(const SymmetricallyProjected& method, const P& p)
        : base(method, p),
          at_start(p.model()->template holonomic_constraints<T>()),
          start(p.make_state()),
          end(p.make_state()),
          by_position(p.holonomic().count()),
          by_momentum(by_position.size()),
          residual(by_position.size()),
          rate(by_position.size()),
          move(p.size() / 2),
          kick(move.size()) {}

    /// state += D m, with H_pp and B of the point where the constraints `at` were placed.
    void shift(const PositionConstraints<T>& at, State<P>& state) {
      const std::size_t n = move.size();
      at.hidden_by_momentum_transpose(by_position, move);
      at.apply_transpose(by_momentum, kick);
      for (std::size_t k = 0; k < n; ++k) {
        state[k] = state[k] + move[k];
        state[n + k] = state[n + k] + kick[k];
      }
    }
  };

  template <HasHolonomic P>
  requires Steps<Base, P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                      Work<P>& w)
  const {
    using T = Scalar<P>;
    PositionConstraints<T>& c = p.holonomic();
    const std::size_t n = w.move.size();
    const In<T> q(w.end.data(), n), momentum(w.end.data() + n, n);
    Status status = w.at_start->linearise(t, In<T>(z.data(), n), In<T>(z.data() + n, n));
    if (status == Status::converged) status = c.linearise(t, In<T>(z.data(), n), In<T>(z.data() + n, n));
    p.counters().factorisations += 2;
    constexpr bool in_turns = true;  // z1 and D(z1) are improved in turns: D(z1) is one iteration behind
    Convergence<T> convergence(in_turns);
    while (status == Status::converged) {
      std::copy(z.begin(), z.end(), w.start.begin());
      w.shift(*w.at_start, w.start);
      std::copy(w.start.begin(), w.start.end(), w.end.begin());
      w.base.restart();
      status = Base::step(p, t, h, w.end, w.base);
      if (status != Status::converged) break;
      w.shift(c, w.end);
      ++p.counters().factorisations;
      status = c.linearise(t + h, q, momentum);
      if (status != Status::converged) break;
      c.values(t + h, q, w.residual);
      c.hidden_values(t + h, q, momentum, w.rate);
      c.solve(w.residual, w.residual, w.rate, w.rate);
      // The multipliers act at both ends of the step, so that half the correction at each is enough.
      for (std::size_t i = 0; i < w.rate.size(); ++i) {
        w.by_position[i] = w.by_position[i] - w.residual[i] / T(2);
        w.by_momentum[i] = w.by_momentum[i] - w.rate[i] / T(2);
      }
      c.hidden_by_momentum_transpose(w.residual, w.move);
      c.apply_transpose(w.rate, w.kick);
      Largest<T> moved, positions, kicked, momenta;
      for (std::size_t k = 0; k < n; ++k) {
        moved.add(w.move[k]);
        positions.add(q[k]);
        kicked.add(w.kick[k]);
        momenta.add(momentum[k]);
      }
      convergence.begin_iteration();
      convergence.add(moved.get(), positions.get(), positions.get());
      convergence.add(kicked.get(), momenta.get(), momenta.get());
      ++p.counters().iterations;
      if (convergence.finished(50)) {
        status = convergence.status() == Status::converged ? Status::converged : Status::not_converged;
        break;
      }
    }
    if (status != Status::converged) {
      for (T& x : w.by_position) x = T(0);
      for (T& x : w.by_momentum) x = T(0);
      return status;
    }
    for (std::size_t k = 0; k < n; ++k) {  // w.end lacks the last correction, which is added here
      z[k] = w.end[k] - w.move[k];
      z[n + k] = w.end[n + k] - w.kick[k];
    }
    return Status::converged;
  }
};

}  // namespace pfaff
