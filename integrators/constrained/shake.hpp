// SHAKE for H = T(p, t) + V(q, t) with constraints phi(q, t) = 0: the positions of RATTLE, with the momenta
// of central differences,
//
//   p1 = p' + h/2 (-V_q(q1, t1)) - B(q1)^T nu,
//   q2 = q1 + h T_p(p1 + h/2 (-V_q(q1, t1)) - B(q1)^T nu, t1 + h/2),   phi(q2, t2) = 0
//
// (ryckaert1977; hairer-lubich-wanner2006 VII.1.4). With quadratic T this is p1 = M (q2 - q0) / (2 h). Since
// p1 contains the multiplier nu that leads the next drift onto phi(q2, t2) = 0, this step already solves for
// it, and the next one starts its iteration from it. Positions are on the surface; the momenta satisfy the
// hidden constraints to second order in h only, and RATTLE's momenta are their projection.
#pragma once

#include <pfaff/integrators/constrained/rattle.hpp>

namespace pfaff {

/// Half a kick, a drift onto phi = 0, half a kick that leads the next drift onto phi = 0.
struct Shake : Rattle {
  static std::vector<Parameter> parameters() {
    return {
        parameter(static_cast<bool Shake::*>(&Shake::compensated), "compensated", "compensated summation")};
  }

  template <class P>
  struct Work : Rattle::Work<P> {
    using T = Scalar<P>;
    std::vector<T> next, next_momentum;
    Work(const Shake& method, const P& p)
        : Rattle::Work<P>(method, p), next(this->n()), next_momentum(this->n()) {}
  };

  template <HasHolonomic P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    PositionConstraints<Scalar<P>>& c = p.holonomic();
    Status status = start(p, c, t, h, z, w);
    if (status == Status::converged) status = drift_onto_positions(p, c, t, h, z, w);
    if (status == Status::converged) status = kick_towards_next(p, c, t + h, h, z, w);
    return end(status, t, h, z, w);
  }

 private:
  // Finds p1: adds to the impulse the second kick, with the multipliers that lead the next drift onto phi =
  // 0.
  template <class P>
  Status kick_towards_next(const P& p, PositionConstraints<Scalar<P>>& c, const Scalar<P>& t,
                           const Scalar<P>& h, const State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = w.n();
    ++p.counters().factorisations;
    if (const Status status = place_at_end(p, t, w); status != Status::converged) return status;
    ++p.counters().fields;
    const T length = w.drift * h, last = w.last * h, first = w.first * h;
    c.apply_transpose(w.multiplier, w.reaction);
    for (std::size_t k = 0; k < n; ++k) {
      w.impulse[k] = w.impulse[k] + (last * w.force[k] - w.reaction[k]);
      w.next_momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]) + (first * w.force[k] - w.reaction[k]);
      w.next[k] = w.position[k];
    }
    CoordinateConvergence<T> convergence;
    bool first_time = true;
    do {
      c.velocity(t + first, w.position, w.next_momentum, w.velocity);
      VectorCorrections<T> moved(convergence.each());
      for (std::size_t k = 0; k < n; ++k) {
        const T change = length * w.velocity[k], next = w.position[k] + change;
        moved.against(next);
        moved.add(next - w.next[k], next, change);
        w.next[k] = next;
      }
      if (!first_time) {
        convergence.begin_iteration();
        convergence.add(moved);
        if (convergence.finished(50)) break;
      }
      first_time = false;
      c.values(t + h, w.next, w.residual);
      c.solve(w.residual, w.residual);
      convergence.kick(w.residual);
      for (std::size_t i = 0; i < w.residual.size(); ++i) {  // the multipliers act in both half kicks
        w.residual[i] = w.residual[i] / (length + length);
        w.multiplier[i] = w.multiplier[i] + w.residual[i];
      }
      c.apply_transpose(w.residual, w.reaction);
      for (std::size_t k = 0; k < n; ++k) {
        w.impulse[k] = w.impulse[k] - w.reaction[k];
        w.next_momentum[k] = w.next_momentum[k] - (w.reaction[k] + w.reaction[k]);
      }
      ++p.counters().iterations;
    } while (true);
    return convergence.status() == Status::converged ? Status::converged : Status::not_converged;
  }
};

}  // namespace pfaff
