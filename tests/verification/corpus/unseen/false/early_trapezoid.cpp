// The implicit trapezoidal rule by functional iteration.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.1 and V.1.
//
// False: `symmetric`: the iteration ends at corrections of u^(3/4), u the round-off, as if the next one were
// the square of the last; it is h |X_z|/2 times the last, and that much of them is left.
#include <algorithm>
#include <limits>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct EarlyTrapezoid {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> next, first, last;
    Work(const EarlyTrapezoid& /*method*/, const P& p)
        : next(p.make_state()), first(p.make_state()), last(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    using Number = Value<T>;
    const Number u = std::numeric_limits<Number>::epsilon(), root = sqrt(u), enough = root * sqrt(root);
    p.field(t, z, w.first);
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k] + h * w.first[k];
    for (int sweep = 0; sweep < 200; ++sweep) {
      p.field(t + h, w.next, w.last);
      Number largest(0), size(0);
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T corrected = z[k] + h / T(2) * (w.first[k] + w.last[k]);
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

const Method<EarlyTrapezoid> registered{
    {.name = "early-trapezoid",
     .title = "implicit trapezoidal rule",
     .reference = "hairer-lubich-wanner2006 II.1",
     .description =
         "The trapezoidal rule by functional iteration. Take it for smooth problems. Steps must be "
         "short enough for the iteration.",
     .order = 2,
     .preserves = {Claim::symmetric}}};
}  // namespace
