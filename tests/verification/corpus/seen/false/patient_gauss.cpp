// The implicit midpoint rule with an end of its iteration of its own.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.4, IV.2 and VIII.6.
//
// False: `quadratic-invariants` fails in large steps: corrections of 2^14 roundings end the iteration.
#include <algorithm>
#include <limits>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct PatientGauss {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> next, middle, rate;
    Work(const PatientGauss& /*method*/, const P& p)
        : next(p.make_state()), middle(p.make_state()), rate(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    using Number = Value<T>;
    const Number enough = Number(16384) * std::numeric_limits<Number>::epsilon();
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k];
    for (int sweep = 0; sweep < 200; ++sweep) {
      for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = (z[k] + w.next[k]) / T(2);
      p.field(t + h / T(2), w.middle, w.rate);
      Number largest(0), size(0);
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T corrected = z[k] + h * w.rate[k];
        largest = std::max(largest, Number(abs(value_of(corrected - w.next[k]))));
        size = std::max(size, Number(abs(value_of(corrected))));
        w.next[k] = corrected;
      }
      if (largest <= enough * size) {
        for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
        return Status::converged;
      }
    }
    return Status::not_converged;
  }
};

const Method<PatientGauss> registered{
    {.name = "patient-gauss",
     .title = "Gauss's method of one stage",
     .reference = "hairer-lubich-wanner2006 IV.2",
     .description = "The midpoint rule by functional iteration. Take it for smooth problems. It solves "
                    "equations in each step.",
     .order = 2,
     .preserves = {Claim::quadratic_invariants}}};
}  // namespace
