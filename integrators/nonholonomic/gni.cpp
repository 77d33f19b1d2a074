// GNI, the geometric nonholonomic integrator, for H(q, p, t) with constraints A(q, t) v + b(q, t) = 0:
//
//   pm = p^+ + h/2 (-H_q(qm, pm)),  qm = q0 + h/2 H_p(qm, pm),     p^+ the mirror image of p^- at q0
//   q1 = qm + h/2 H_p(qm, pm),      p^- = pm + h/2 (-H_q(qm, pm))  at q1
//
// (ferraro-iglesias-martin-de-diego2008): a variational step, which knows nothing of the constraints, between
// reflections of the momentum by them (reflected_momentum.hpp). Order 2, symmetric and reversible together
// with the reaction that is carried, psi = 0 to round-off at the ends of steps. The update is compensated.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/nonholonomic/middle_point.hpp>
#include <pfaff/integrators/nonholonomic/reflected_momentum.hpp>

namespace {
using namespace pfaff;

struct GeometricNonholonomicIntegrator : ReflectedMomentum {
  static std::vector<Parameter> parameters() {
    return {parameter(
        static_cast<bool GeometricNonholonomicIntegrator::*>(&GeometricNonholonomicIntegrator::compensated),
        "compensated", "compensated summation")};
  }

  template <class P>
  struct Work : ReflectedMomentum::Work<P> {
    MiddlePoint<Scalar<P>> middle;
    Work(const GeometricNonholonomicIntegrator& method, const P& p)
        : ReflectedMomentum::Work<P>(method, p), middle(p.model(), 0) {}
  };

  template <HasVelocityConstraints P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = w.n();
    const In<T> q0(z.data(), n), p0(z.data() + n, n), q_carry(w.carry.data(), n);
    const T first = w.first * h, length = first + w.second * h;
    Status status = leave(p, t, h, z, w);
    if (status == Status::converged) {
      for (std::size_t k = 0; k < n; ++k) w.momentum[k] = w.impulse[k] + w.carry[n + k];
      status = w.middle.solve(p, p.nonholonomic(), t, h, first, q0, q_carry, p0, w.momentum);
    }
    if (status == Status::converged) {
      for (std::size_t k = 0; k < n; ++k) {
        w.displacement[k] = length * w.middle.velocity()[k];
        w.impulse[k] = w.impulse[k] + length * w.middle.force()[k];
        w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
      }
      status = arrive(p, t, h, z, w);
    }
    if (status != Status::converged) {
      w.forget();
      w.middle.forget();
      return status;
    }
    w.middle.remember(h);
    return Status::converged;
  }
};

const Method<GeometricNonholonomicIntegrator> registered{
    {.name = "gni",
     .title = "geometric nonholonomic integrator: variational steps between reflections of the momentum",
     .family = "nonholonomic",
     .reference = "ferraro-iglesias-martin-de-diego2008",
     .description =
         "A variational step at its middle between reflections of the momentum by the velocity constraints, "
         "of order 2, for any energy H(q, p, t). Take it to compare with `dla`: it solves for no "
         "multipliers, "
         "and is symmetric and reversible too. It remembers the reaction of the last step, so that it cannot "
         "be "
         "composed, and starts without one. Where motion is attracted, as that of `sleigh` is, this reaction "
         "grows exponentially, and the method is of no use after the time at which it is as large as "
         "momenta.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::velocity_constraints,
                   Claim::nonholonomic_momentum}}};
}  // namespace
