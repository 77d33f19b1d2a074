// The leap-frog scheme, the explicit two-step midpoint rule for any vector field:
//
//   z_{n+1} = z_{n-1} + 2 h X(z_n, t_n)
//
// (hairer-norsett-wanner1993, III.1, (1.13')), one of the conventional schemes that su-qin (section 1) names
// as not Birkhoffian. The first step, and the first after a change of step or of state from outside, is a
// leap over the half interval: z_1 = z_0 + h X(z_{1/2}), z_{1/2} = z_0 + h/2 X(z_0). Order 2, one right-hand
// side a step. It keeps no structure, and it is only weakly stable: where the motion decays, a
// parasitic oscillation between odd and even steps grows at the same rate.
//
// Each leap is compensated. A restarted step has no history, so the Jacobian and the symmetry of a single
// step are those of the starting step.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include <pfaff/core/errors/status.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace pfaff {

/// The explicit two-step midpoint rule.
struct LeapFrog {
  /// The length of the starting half interval in units of h, and that of a leap in units of what it spans.
  std::array<Quad, 2> lengths{Quad(1) / Quad(2), Quad(1)};
  bool compensated = true;

  static std::vector<Parameter> parameters() {
    return {parameter(&LeapFrog::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return lengths; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T half, leap;
    State<P> before, carry_before, carry, rate;  // `before` is z_{n-1}; each sum has its own compensation
    Continuation<P> continuation;
    Work(const LeapFrog& method, const P& p)
        : half(Real(method.lengths[0])),
          leap(Real(method.lengths[1])),
          before(p.make_state()),
          carry_before(p.make_state()),
          carry(p.make_state()),
          rate(p.make_state()),
          continuation(p) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.rate);
    const bool started = w.continuation.holds(t, h, z);
    if (!started) {  // z_{1/2} takes the place of z_n, and z_0 that of z_{n-1}
      const T half = w.half * h;
      for (std::size_t k = 0; k < z.size(); ++k) {
        w.before[k] = z[k];
        w.carry[k] = w.carry_before[k] = T(0);
        z[k] = z[k] + half * w.rate[k];
      }
      p.field(t + half, z, w.rate);
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.before[k];
    }
    const T span = w.leap * (started ? h + h : h);
    for (std::size_t k = 0; k < z.size(); ++k) {
      T next = w.before[k], carry = w.carry_before[k];
      add_to(next, carry, span * w.rate[k], compensated);
      w.before[k] = z[k];
      w.carry_before[k] = w.carry[k];
      z[k] = next;
      w.carry[k] = carry;
    }
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

}  // namespace pfaff
