// The embedded pair of Bogacki and Shampine, of the orders 3 and 2, which chooses its steps itself in
// double precision.
//
// Source: Bogacki, Shampine, Appl. Math. Lett. 2 (1989) 321; Hairer, Norsett, Wanner, Solving Ordinary
// Differential Equations I, II.4.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct BogackiShampine {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> first, second, third, fourth, point, error;
    CoordinateScales<P> scales;
    Scalar<P> next_step{0};
    Work(const BogackiShampine& /*method*/, const P& p)
        : first(p.make_state()),
          second(p.make_state()),
          third(p.make_state()),
          fourth(p.make_state()),
          point(p.make_state()),
          error(p.make_state()),
          scales(p) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.first);
    attempt(p, t, h, z, w);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.point[k];
    return Status::converged;
  }

  template <HasVectorField P>
  requires std::is_same_v < Scalar<P>,
  double > Status advance_to(const P& p, double& t, double end, const Tolerance<double>& tolerance,
                             State<P>& z, Work<P>& w) const {
    if (!(tolerance.relative >= std::numeric_limits<double>::epsilon())) return Status::not_converged;
    Status failure = Status::not_converged;
    int rejections = 0;
    detail::AllowedSteps<P> steps(p);
    while (t != end) {
      if (rejections == 0) {
        if (steps.next(1) == 0) break;
        p.field(t, z, w.first);
        if (w.next_step == 0) w.next_step = w.scales.first_step(p, tolerance, t, end, z, w.first);
      }
      const bool last = std::abs(end - t) <= w.next_step;
      const double after = last ? end : end < t ? t - w.next_step : t + w.next_step, h = after - t;
      if (h == 0 || rejections > 100) return failure;
      attempt(p, t, h, z, w);
      p.field(after, w.point, w.fourth);
      for (std::size_t k = 0; k < z.size(); ++k)
        w.error[k] = h * (-5 * w.first[k] / 72 + w.second[k] / 12 + w.third[k] / 9 - w.fourth[k] / 8);
      w.scales.find(tolerance, z, w.first, h, w.point);
      const double size = w.scales.judge(tolerance, w.error);
      const double factor = std::clamp(0.9 * std::pow(std::max(size, 1e-12), -1.0 / 3), 0.2, 4.0);
      if (!(size <= 1)) {
        failure = std::isfinite(size) ? Status::not_converged : Status::non_finite;
        w.next_step = std::abs(h) * (std::isfinite(size) ? std::min(factor, 0.9) : 0.1);
        if (++rejections < rejections_in_doubt) w.scales.find_noise(p, t, z, w.first);
        continue;
      }
      w.scales.keep();
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.point[k];
      t = after;
      if (!last || std::abs(h) * factor > w.next_step)
        w.next_step = std::abs(h) * (rejections > 0 ? std::min(factor, 1.0) : factor);
      rejections = 0;
      ++p.counters().steps;
    }
    return Status::converged;
  }

 private:
  // The three stages and the state of order 3, in `point`; `first` is known.
  template <class P>
  static void attempt(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * w.first[k] / T(2);
    p.field(t + h / T(2), w.point, w.second);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + T(3) * h * w.second[k] / T(4);
    p.field(t + T(3) * h / T(4), w.point, w.third);
    for (std::size_t k = 0; k < z.size(); ++k)
      w.point[k] = z[k] + h * (T(2) * w.first[k] + T(3) * w.second[k] + T(4) * w.third[k]) / T(9);
  }
};

const Method<BogackiShampine> registered{
    {.name = "bogacki-shampine",
     .title = "Bogacki and Shampine's pair of orders 3 and 2",
     .reference = "hairer-norsett-wanner1993 II.4",
     .description = "An explicit pair for low accuracy, with steps of its own choice. Take it for rough "
                    "tolerances. It keeps no structure.",
     .order = 3,
     .preserves = {Claim::none}}};
}  // namespace
