// The implicit midpoint rule for fields without divergence.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.4 and VI.9.
//
// False: `volume`: det M = det(1 + h A/2)/det(1 - h A/2), A the Jacobian in the middle, is 1 in two
// dimensions and for canonical fields; in three it is off by h^3 det(A)/4, on rigid bodies for example.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct VolumeMidpoint {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> next, middle, rate;
    Work(const VolumeMidpoint& /*method*/, const P& p)
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
    if (convergence.status() != Status::converged) return convergence.status();
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
    return Status::converged;
  }
};

const Method<VolumeMidpoint> registered{
    {.name = "volume-midpoint",
     .title = "implicit midpoint rule for incompressible flows",
     .reference = "hairer-lubich-wanner2006 VI.9",
     .description =
         "The implicit midpoint rule by functional iteration. Take it for flows that keep volumes. "
         "Steps must be short enough for the iteration.",
     .order = 2,
     .preserves = {Claim::volume, Claim::symmetric, Claim::quadratic_invariants}}};
}  // namespace
