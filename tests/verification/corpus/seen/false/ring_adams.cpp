// The explicit method of Adams and Bashforth of two steps, with the slopes of past steps in a ring of 32
// places.
//
// Source: Bashforth, Adams (1883); Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I,
// III.1.
//
// False: `order` is 2 for 32 steps only; a full ring loses its slopes, and Euler's step makes the order 1.
#include <array>

#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace {
using namespace pfaff;

struct RingAdams {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    std::array<State<P>, 32> slopes;
    State<P> point, middle;
    std::size_t known = 0;
    Continuation<P> continuation;
    Work(const RingAdams& /*method*/, const P& p)
        : point(p.make_state()), middle(p.make_state()), continuation(p) {
      for (State<P>& slope : slopes) slope = p.make_state();
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const bool starts = !w.continuation.holds(t, h, z);
    if (starts || w.known == w.slopes.size()) w.known = 0;
    State<P>& rate = w.slopes[w.known];
    p.field(t, z, rate);
    if (starts) {
      for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * rate[k] / T(2);
      p.field(t + h / T(2), w.point, w.middle);
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * w.middle[k];
    } else if (w.known == 0) {
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * rate[k];
    } else {
      const State<P>& before = w.slopes[w.known - 1];
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * (T(3) * rate[k] - before[k]) / T(2);
    }
    ++w.known;
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }
};

const Method<RingAdams> registered{
    {.name = "ring-adams",
     .title = "Adams and Bashforth's method of two steps",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description = "One evaluation a step and order 2. Take it where the field is dear. It keeps no "
                    "structure.",
     .order = 2,
     .preserves = {Claim::none}}};
}  // namespace
