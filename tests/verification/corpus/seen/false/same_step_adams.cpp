// The explicit method of Adams and Bashforth with two steps, z_(n+1) = z_n + h (3 f_n - f_(n-1))/2, of order
// 2, which starts with Heun's method.
//
// Source: Bashforth, Adams (1883); Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, III.1.
//
// False: the order, where a step is of another size than the one before. The rate f_(n-1) is then taken for
// that of one step ago, which it is not.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace {
using namespace pfaff;

struct SameStepAdams {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> now, before, middle;
    Continuation<P> continuation;
    Work(const SameStepAdams& /*method*/, const P& p)
        : now(p.make_state()), before(p.make_state()), middle(p.make_state()), continuation(p) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.now);
    if (w.continuation.holds_at(t, h, z)) {
      for (std::size_t k = 0; k < z.size(); ++k) z[k] += h * (T(3) * w.now[k] - w.before[k]) / T(2);
    } else {
      for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = z[k] + h * w.now[k];
      p.field(t + h, w.middle, w.before);
      for (std::size_t k = 0; k < z.size(); ++k) z[k] += h * (w.now[k] + w.before[k]) / T(2);
    }
    w.before = w.now;
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

const Method<SameStepAdams> registered{
    {.name = "same-step-adams",
     .title = "explicit method of Adams and Bashforth with two steps",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description = "A multistep method of order 2 with one right-hand side a step. It keeps no structure.",
     .order = 2,
     .preserves = {Claim::none}}};
}  // namespace
