// The classical Runge-Kutta method of four stages.
//
// Source: Kutta, Z. Math. Phys. 46 (1901) 435; Hairer, Norsett, Wanner, Solving Ordinary Differential
// Equations I, II.1.
//
// False: `order` is 4 for 96 steps only; each 97th step leaves a stage out, and the order of a run is 2.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct SavingRungeKutta {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> first, second, third, fourth, point;
    int taken = 0;
    Work(const SavingRungeKutta& /*method*/, const P& p)
        : first(p.make_state()),
          second(p.make_state()),
          third(p.make_state()),
          fourth(p.make_state()),
          point(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.first);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * w.first[k] / T(2);
    p.field(t + h / T(2), w.point, w.second);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * w.second[k] / T(2);
    if (++w.taken % 97 == 0) {
      for (std::size_t k = 0; k < z.size(); ++k) w.third[k] = w.second[k];
    } else {
      p.field(t + h / T(2), w.point, w.third);
    }
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * w.third[k];
    p.field(t + h, w.point, w.fourth);
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = z[k] + h * (w.first[k] + T(2) * (w.second[k] + w.third[k]) + w.fourth[k]) / T(6);
    return Status::converged;
  }
};

const Method<SavingRungeKutta> registered{
    {.name = "saving-runge-kutta",
     .title = "classical Runge-Kutta method",
     .reference = "hairer-norsett-wanner1993 II.1",
     .description = "The classical method of four stages. Take it for short runs. It keeps no structure.",
     .order = 4,
     .preserves = {Claim::none}}};
}  // namespace
