// The implicit midpoint rule, which saves work once it has taken some steps.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.4 and VI.4.
//
// False: `symplectic` holds for 17 steps only; all later ones are of the explicit midpoint rule.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct LazyMidpoint {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> next, middle, rate;
    int taken = 0;
    Work(const LazyMidpoint& /*method*/, const P& p)
        : next(p.make_state()), middle(p.make_state()), rate(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.rate);
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k] + h * w.rate[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = (z[k] + w.next[k]) / T(2);
      p.field(t + h / T(2), w.middle, w.rate);
      convergence.begin_iteration();
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T corrected = z[k] + h * w.rate[k];
        convergence.add(corrected - w.next[k], z[k], corrected);
        w.next[k] = corrected;
      }
    } while (w.taken < 17 && !convergence.finished(200));
    if (w.taken < 17 && convergence.status() != Status::converged) return convergence.status();
    ++w.taken;
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
    return Status::converged;
  }
};

const Method<LazyMidpoint> registered{
    {.name = "lazy-midpoint",
     .title = "implicit midpoint rule",
     .reference = "hairer-lubich-wanner2006 II.1",
     .description = "The midpoint rule by functional iteration. Take it for smooth problems. It solves "
                    "equations in each step.",
     .order = 2,
     .preserves = {Claim::symplectic}}};
}  // namespace
