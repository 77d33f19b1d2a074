// The nonholonomic leap-frog for H = T(p, t) + V(q, t) with constraints A(q, t) v + b(q, t) = 0. With the
// momentum p_{k+1/2} between q_k and q_{k+1} it is
//
//   p_{k+1/2} = p_{k-1/2} + h (-V_q(q_k)) - A(q_k)^T lambda,   A(q_k) (v_{k-1/2} + v_{k+1/2})/2 + b(q_k) = 0
//   q_{k+1} = q_k + h T_p(p_{k+1/2}, t_{k+1/2})
//
// (mclachlan-perlmutter2006): Stoermer-Verlet between reflections of the momentum (reflected_momentum.hpp),
// p^+ = p_{k+1/2} + h/2 V_q(q_k) and p^- = p_{k+1/2} - h/2 V_q(q_{k+1}). Order 2, explicit with one force and
// one factorisation a step; symmetric and reversible together with the reaction that is carried, psi = 0 to
// round-off at the ends of steps. The method mclachlan-perlmutter is the same seen from the points between.
// The update is compensated.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/nonholonomic/energy_slopes.hpp>
#include <pfaff/integrators/nonholonomic/reflected_momentum.hpp>

namespace {
using namespace pfaff;

struct NonholonomicLeapFrog : ReflectedMomentum {
  static std::vector<Parameter> parameters() {
    return {parameter(static_cast<bool NonholonomicLeapFrog::*>(&NonholonomicLeapFrog::compensated),
                      "compensated", "compensated summation")};
  }
  [[nodiscard]] std::string refuses(const Model& model) const {
    if (model.separable_energy()) return {};
    return "needs H = T(p, t) + V(q, t); the Hamiltonian of " + model.name() +
           " is not written as kinetic and potential energy: take dla or gni";
  }

  template <class P>
  struct Work : ReflectedMomentum::Work<P> {
    EnergySlopes<Scalar<P>> slopes;
    std::vector<Scalar<P>> velocity, force;  // the force where the last step ended
    Work(const NonholonomicLeapFrog& method, const P& p)
        : ReflectedMomentum::Work<P>(method, p), slopes(p.model()), velocity(this->n()), force(this->n()) {}
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = w.n();
    const T first = w.first * h, second = w.second * h, length = first + second;
    if (!w.continues(t, h, z)) {
      ++p.counters().fields;
      w.slopes.force(t, In<T>(z.data(), n), w.force);
    }
    Status status = leave(p, t, h, z, w);
    if (status == Status::converged) {
      for (std::size_t k = 0; k < n; ++k) {
        w.impulse[k] = w.impulse[k] + first * w.force[k];
        w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
      }
      w.slopes.velocity(t + first, w.momentum, w.velocity);
      for (std::size_t k = 0; k < n; ++k) {
        w.displacement[k] = length * w.velocity[k];
        w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
      }
      ++p.counters().fields;
      w.slopes.force(t + h, w.position, w.force);
      for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] + second * w.force[k];
      status = arrive(p, t, h, z, w);
    }
    if (status != Status::converged) w.forget();
    return status;
  }
};

const Method<NonholonomicLeapFrog> registered{
    {.name = "nonholonomic-leap-frog",
     .title = "nonholonomic leap-frog: Stoermer-Verlet between reflections of the momentum",
     .family = "nonholonomic",
     .reference = "mclachlan-perlmutter2006",
     .description =
         "Stoermer-Verlet between reflections of the momentum by the velocity constraints, of order 2, "
         "explicit "
         "and the cheapest of its kind: one force and one factorisation a step. Take it for long runs of "
         "systems with H = T(p, t) + V(q, t), which it needs. It remembers the reaction of the last step, so "
         "that "
         "it cannot be composed, and starts without one.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::velocity_constraints,
                   Claim::nonholonomic_momentum}}};
}  // namespace
