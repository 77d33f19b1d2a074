// The implicit midpoint rule for energies with a bracket that depends on the state, such as rigid bodies and
// tops,
//
//   z' = z + h Pi(m) dH(m),   m = (z + z')/2, at the time t + h/2.
//
// Source: Austin, Krishnaprasad, Wang, Almost Poisson integration of rigid body systems, J. Comput. Phys. 107
// (1993) 105; Hairer, Lubich, Wanner, Geometric Numerical Integration, VII.4.
//
// False: the claim that it is a Poisson map. It is one for constant brackets. For a bracket that is linear in
// the state it keeps quadratic Casimirs, and so the orbits on which the bracket lives, but the bracket itself
// only up to terms of order 3 in the step.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

template <class P>
concept HasBracket = HasVectorField<P> && requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.poisson_tensor(t, z, z);
};

struct MidpointForBrackets {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> next, middle, rate;
    Work(const MidpointForBrackets& /*method*/, const P& p)
        : next(p.make_state()), middle(p.make_state()), rate(p.make_state()) {}
  };

  template <HasBracket P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = (z[k] + w.next[k]) / T(2);
      p.field(t + h / T(2), w.middle, w.rate);
      convergence.begin_iteration();
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T found = z[k] + h * w.rate[k];
        convergence.add(found - w.next[k], z[k], found);
        w.next[k] = found;
      }
    } while (!convergence.finished(300));
    if (convergence.status() == Status::converged)
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
    return convergence.status();
  }
};

const Method<MidpointForBrackets> registered{
    {.name = "midpoint-for-brackets",
     .title = "implicit midpoint rule for energies with a bracket of their own",
     .reference = "hairer-lubich-wanner2006 VII.4",
     .description = "The implicit midpoint rule, for rigid bodies and other motions on orbits in the duals "
                    "of Lie algebras, whose quadratic "
                    "Casimirs it keeps.",
     .order = 2,
     .preserves = {Claim::symplectic, Claim::poisson, Claim::quadratic_invariants, Claim::symmetric,
                   Claim::reversible}}};
}  // namespace
