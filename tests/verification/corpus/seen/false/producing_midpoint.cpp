// The implicit midpoint rule, solved by functional iteration, for systems with an entropy.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.4 and VIII.6.
//
// False: `entropy` holds where the entropy is quadratic, whose value the rule keeps but for what friction
// produces; another entropy falls by errors of the step where little is produced.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct ProducingMidpoint {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> next, middle, rate;
    Work(const ProducingMidpoint& /*method*/, const P& p)
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
    } while (!convergence.finished(200));
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
    return convergence.status();
  }
};

const Method<ProducingMidpoint> registered{
    {.name = "producing-midpoint",
     .title = "implicit midpoint rule by functional iteration",
     .reference = "hairer-lubich-wanner2006 VIII.6",
     .description = "The midpoint rule by functional iteration. Take it for smooth problems. It solves "
                    "equations in each step.",
     .order = 2,
     .preserves = {Claim::symplectic, Claim::entropy}}};
}  // namespace
