// The reversible method of McLachlan and Perlmutter for H = T(p, t) + V(q, t) with constraints A(q, t) v +
// b(q, t) = 0:
//
//   qm = q0 + h/2 T_p(p0),   p1 = p0 + h (-V_q(qm)) - A(qm)^T lambda,   q1 = qm + h/2 T_p(p1)
//   A(qm) (v0 + v1)/2 + b(qm) = 0 with v = T_p,   V, A and b at the time of the middle
//
// (mclachlan-perlmutter2006). One force and one factorisation a step; where T is quadratic, lambda is that of
// one linear solve. Order 2; symmetric and reversible as a map of all states (q, p). The constraints hold for
// the mean of v0 and v1 in the middle of the step, and at its ends up to an error of order h^2 that does not
// add up. |v| in the metric of T is exact where there is no potential. The update is compensated.
//
// Compositions of it are not offered: they reach order 4 and no more (measured with weights made for order
// 6), because the error at the ends depends on the sub-step.
#include <array>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>
#include <pfaff/integrators/nonholonomic/energy_slopes.hpp>

namespace {
using namespace pfaff;

struct McLachlanPerlmutter {
  /// The drift, the kick and the drift, in units of the step.
  std::array<Quad, 3> lengths{Quad(1) / Quad(2), Quad(1), Quad(1) / Quad(2)};
  bool compensated = true;

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  static std::vector<Parameter> parameters() {
    return {parameter(&McLachlanPerlmutter::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return lengths; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    if (model.separable_energy()) return {};
    return "needs H = T(p, t) + V(q, t); the Hamiltonian of " + model.name() +
           " is not written as kinetic and potential energy: take dla or gni";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T first, kick, last;   // the lengths
    std::vector<T> carry;  // what the sums of q and p have rounded off
    std::vector<T> velocity, force, displacement, impulse, position, momentum, before, residual, reaction;
    EnergySlopes<T> slopes;
    bool linear;  // T_p is linear in p

    Work(const McLachlanPerlmutter& method, const P& p)
        : first(Real(method.lengths[0])),
          kick(Real(method.lengths[1])),
          last(Real(method.lengths[2])),
          carry(p.size()),
          velocity(n()),
          force(n()),
          displacement(n()),
          impulse(n()),
          position(n()),
          momentum(n()),
          before(p.nonholonomic().count()),
          residual(before.size()),
          reaction(n()),
          slopes(p.model()) {
      linear = velocity_is_linear<T>(p.nonholonomic(), generic_time<T>(), generic_positions<T>(n()));
    }
    [[nodiscard]] std::size_t n() const { return carry.size() / 2; }
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    VelocityConstraints<T>& c = p.nonholonomic();
    const std::size_t n = w.n();
    const T middle = t + w.first * h;
    for (std::size_t k = 0; k < n; ++k) w.momentum[k] = z[n + k] + w.carry[n + k];
    w.slopes.velocity(t, w.momentum, w.velocity);
    for (std::size_t k = 0; k < n; ++k) {
      w.displacement[k] = w.first * h * w.velocity[k];
      w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
    }
    ++p.counters().fields;
    w.slopes.force(middle, w.position, w.force);
    ++p.counters().factorisations;
    if (const Status status = c.linearise(middle, w.position, w.momentum); status != Status::converged)
      return status;
    c.values(middle, w.position, w.momentum, w.before);
    for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.kick * h * w.force[k];
    if (const Status status = reflect<P>(c, middle, z, w); status != Status::converged) return status;
    w.slopes.velocity(t + h, w.momentum, w.velocity);
    for (std::size_t k = 0; k < n; ++k) {
      w.displacement[k] = w.displacement[k] + w.last * h * w.velocity[k];
      add_to(z[k], w.carry[k], w.displacement[k], compensated);
      add_to(z[n + k], w.carry[n + k], w.impulse[k], compensated);
    }
    return Status::converged;
  }

 private:
  // Adds the reactions to the impulse with which the constraints hold for the mean of both velocities, and
  // leaves p1 in `momentum`.
  template <class P>
  static Status reflect(VelocityConstraints<Scalar<P>>& c, const Scalar<P>& middle, const State<P>& z,
                        Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n();
    CoordinateConvergence<T> convergence;
    do {
      for (std::size_t k = 0; k < n; ++k) w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
      c.values(middle, w.position, w.momentum, w.residual);
      for (std::size_t i = 0; i < w.residual.size(); ++i) w.residual[i] = w.residual[i] + w.before[i];
      c.solve(w.residual, w.residual);
      convergence.kick(w.residual);
      c.apply_transpose(w.residual, w.reaction);
      VectorCorrections<T> kicked(convergence.each());
      for (std::size_t k = 0; k < n; ++k) {
        w.impulse[k] = w.impulse[k] - w.reaction[k];
        kicked.against(z[n + k]);
        kicked.against(w.impulse[k]);
        kicked.add(w.reaction[k], z[n + k], w.impulse[k]);
      }
      if (w.linear) break;
      convergence.begin_iteration();
      convergence.add(kicked);
    } while (!convergence.finished(50));
    for (std::size_t k = 0; k < n; ++k) w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
    return w.linear ? Status::converged : convergence.status();
  }
};

const Method<McLachlanPerlmutter> registered{
    {.name = "mclachlan-perlmutter",
     .title = "reversible method of McLachlan and Perlmutter for velocity constraints",
     .family = "nonholonomic",
     .reference = "mclachlan-perlmutter2006",
     .description =
         "A drift, a kick that reflects the momentum by the velocity constraints in the middle of "
         "the step, and "
         "a drift: order 2, symmetric and reversible, with one force and one factorisation a "
         "step. Take it for "
         "long runs of systems with H = T(p, t) + V(q, t), which it needs, where constraints have to "
         "hold at the "
         "middles of steps only: at the ends they are off by a bounded error of order h^2.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::nonholonomic_momentum}}};
}  // namespace
