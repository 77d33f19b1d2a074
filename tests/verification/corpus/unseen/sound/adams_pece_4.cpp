// The predictor of Adams and Bashforth with three steps and the corrector of Adams and Moulton of order 4,
// evaluated after each:
//
//   z* = z_n + h (23 f_n - 16 f_(n-1) + 5 f_(n-2))/12
//   z_(n+1) = z_n + h (9 f* + 19 f_n - 5 f_(n-1) + f_(n-2))/24
//
// The first two steps, and two steps after the state, the time or the step has been changed from outside, are
// those of the classical method of Runge and Kutta. Two right-hand sides a step.
//
// Source: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, III.1.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace {
using namespace pfaff;

struct AdamsPece {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> now, before, earlier, slope, point, sum, carry;
    int known = 0;  // how many rates of past states there are
    Continuation<P> continuation;
    Work(const AdamsPece& /*method*/, const P& p)
        : now(p.make_state()),
          before(p.make_state()),
          earlier(p.make_state()),
          slope(p.make_state()),
          point(p.make_state()),
          sum(p.make_state()),
          carry(p.make_state()),
          continuation(p) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    if (!w.continuation.holds(t, h, z)) {
      w.known = 0;
      for (std::size_t k = 0; k < n; ++k) w.carry[k] = T(0);
    }
    p.field(t, z, w.now);
    if (w.known < 2) {
      start(p, t, h, z, w);
    } else {
      for (std::size_t k = 0; k < n; ++k)
        w.point[k] = z[k] + h * (T(23) * w.now[k] - T(16) * w.before[k] + T(5) * w.earlier[k]) / T(12);
      p.field(t + h, w.point, w.slope);
      for (std::size_t k = 0; k < n; ++k)
        w.sum[k] = h * (T(9) * w.slope[k] + T(19) * w.now[k] - T(5) * w.before[k] + w.earlier[k]) / T(24);
    }
    for (std::size_t k = 0; k < n; ++k) {
      compensated_add(z[k], w.carry[k], w.sum[k]);
      w.earlier[k] = w.before[k];
      w.before[k] = w.now[k];
    }
    w.known = w.known < 2 ? w.known + 1 : 2;
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

 private:
  // The change of a step of the classical method of Runge and Kutta.
  template <class P>
  static void start(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    const T half = h / T(2);
    for (std::size_t k = 0; k < n; ++k) {
      w.sum[k] = h * w.now[k] / T(6);
      w.point[k] = z[k] + half * w.now[k];
    }
    p.field(t + half, w.point, w.slope);
    for (std::size_t k = 0; k < n; ++k) {
      w.sum[k] = w.sum[k] + h * w.slope[k] / T(3);
      w.point[k] = z[k] + half * w.slope[k];
    }
    p.field(t + half, w.point, w.slope);
    for (std::size_t k = 0; k < n; ++k) {
      w.sum[k] = w.sum[k] + h * w.slope[k] / T(3);
      w.point[k] = z[k] + h * w.slope[k];
    }
    p.field(t + h, w.point, w.slope);
    for (std::size_t k = 0; k < n; ++k) w.sum[k] = w.sum[k] + h * w.slope[k] / T(6);
  }
};

const Method<AdamsPece> registered{{.name = "adams-pece-4",
                                    .title = "predictor and corrector of Adams, of order 4",
                                    .reference = "hairer-norsett-wanner1993 III.1",
                                    .description = "A multistep method with two right-hand sides a step, for "
                                                   "smooth motions that are not stiff. It keeps no "
                                                   "structure.",
                                    .order = 4,
                                    .preserves = {Claim::none}}};
}  // namespace
