// The implicit midpoint rule for energies with friction, q' = T_p(p, t), p' = -V_q(q, t) - nu p: half a step
// of the friction, solved exactly, a step of the midpoint rule without friction, and half a step of the
// friction. The canonical structure decays by e^(-nu h) in a step.
//
// Source: Bhatt, Floyd, Moore, Second order conformal symplectic schemes for damped Hamiltonian systems, J.
// Sci. Comput. 66 (2016) 1234.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct DampedMidpoint {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> start, next, middle, rate;
    Work(const DampedMidpoint& /*method*/, const P& p)
        : start(p.make_state()), next(p.make_state()), middle(p.make_state()), rate(p.make_state()) {}
  };

  template <HasConformal P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size(), m = n / 2;
    const T time = t + h / T(2), decay = exp(-(p.damping() * h) / T(2));
    for (std::size_t k = 0; k < n; ++k) w.next[k] = w.start[k] = k < m ? z[k] : T(decay * z[k]);
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < n; ++k) w.middle[k] = (w.start[k] + w.next[k]) / T(2);
      p.undamped_velocity(time, In<T>(w.middle.data() + m, m), Out<T>(w.rate.data(), m));
      p.undamped_force(time, In<T>(w.middle.data(), m), Out<T>(w.rate.data() + m, m));
      convergence.begin_iteration();
      for (std::size_t k = 0; k < n; ++k) {
        const T found = w.start[k] + h * w.rate[k];
        convergence.add(found - w.next[k], w.start[k], found);
        w.next[k] = found;
      }
    } while (!convergence.finished(300));
    if (convergence.status() != Status::converged) return convergence.status();
    for (std::size_t k = 0; k < n; ++k) z[k] = k < m ? w.next[k] : T(decay * w.next[k]);
    return Status::converged;
  }
};

const Method<DampedMidpoint> registered{
    {.name = "damped-midpoint",
     .title = "implicit midpoint rule between half steps of the friction",
     .reference = "bhatt2016",
     .description = "A conformal symplectic method of order 2 for linear friction. Take it where explicit "
                    "kicks would be "
                    "unstable.",
     .order = 2,
     .preserves = {Claim::conformal, Claim::k_symplectic, Claim::symmetric}}};
}  // namespace
