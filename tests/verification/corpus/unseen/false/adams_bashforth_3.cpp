// The explicit method of Adams and Bashforth with three steps, z_(n+1) = z_n + h (23 f_n - 16 f_(n-1) + 5
// f_(n-2))/12, of order 3. It starts, at the beginning and after every change from outside, with the methods
// of its own family of one and of two steps.
//
// Source: Bashforth, Adams (1883); Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, III.1.
//
// False: the order. The first step is Euler's, whose error h^2/2 z'' stays in the solution, so that the order
// is 2. Two steps of a method of order 2 at least would have been needed.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace {
using namespace pfaff;

struct AdamsBashforth {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> now, before, earlier, carry;
    int known = 0;  // how many rates of past states there are
    Continuation<P> continuation;
    Work(const AdamsBashforth& /*method*/, const P& p)
        : now(p.make_state()),
          before(p.make_state()),
          earlier(p.make_state()),
          carry(p.make_state()),
          continuation(p) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (!w.continuation.holds(t, h, z)) {
      w.known = 0;
      for (std::size_t k = 0; k < z.size(); ++k) w.carry[k] = T(0);
    }
    p.field(t, z, w.now);
    for (std::size_t k = 0; k < z.size(); ++k) {
      T slope = w.now[k];
      if (w.known == 1) slope = (T(3) * w.now[k] - w.before[k]) / T(2);
      if (w.known == 2) slope = (T(23) * w.now[k] - T(16) * w.before[k] + T(5) * w.earlier[k]) / T(12);
      compensated_add(z[k], w.carry[k], T(h * slope));
      w.earlier[k] = w.before[k];
      w.before[k] = w.now[k];
    }
    w.known = w.known < 2 ? w.known + 1 : 2;
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

const Method<AdamsBashforth> registered{
    {.name = "adams-bashforth-3",
     .title = "explicit method of Adams and Bashforth with three steps",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description = "A multistep method of order 3 with one right-hand side a step. It keeps no structure.",
     .order = 3,
     .preserves = {Claim::none}}};
}  // namespace
