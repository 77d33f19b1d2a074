// Merson's explicit method of order 4 with five stages, the first with an estimate of its error:
//
//   c = (0, 1/3, 1/3, 1/2, 1),   k_3 from (k_1 + k_2)/6,   k_4 from (k_1 + 3 k_3)/8,
//   k_5 from k_1/2 - 3 k_3/2 + 2 k_4,   z' = z + h (k_1 + 4 k_4 + k_5)/6.
//
// Source: Merson, An operational method for the study of integration processes (1957); Hairer, Norsett,
// Wanner, Solving Ordinary Differential Equations I, II.4.
//
// False: the order. The third stage is evaluated at the time t + h/2 in place of t + h/3, so that the order
// is 4 for fields that do not depend on time, and lower for those that do: with f(t) alone it still is, but
// not where the field depends on both.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct Merson {
  template <class P>
  struct Work {
    std::array<State<P>, 5> rate;
    State<P> point, carry;
    Work(const Merson& /*method*/, const P& p) : point(p.make_state()), carry(p.make_state()) {
      for (State<P>& r : rate) r = p.make_state();
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    auto& [a, b, c, d, e] = w.rate;
    const T third = h / T(3), half = h / T(2);
    p.field(t, z, a);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + third * a[k];
    p.field(t + third, w.point, b);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * (a[k] + b[k]) / T(6);
    p.field(t + half, w.point, c);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * (a[k] + T(3) * c[k]) / T(8);
    p.field(t + half, w.point, d);
    for (std::size_t k = 0; k < z.size(); ++k)
      w.point[k] = z[k] + h * (a[k] - T(3) * c[k] + T(4) * d[k]) / T(2);
    p.field(t + h, w.point, e);
    for (std::size_t k = 0; k < z.size(); ++k)
      compensated_add(z[k], w.carry[k], T(h * (a[k] + T(4) * d[k] + e[k]) / T(6)));
    return Status::converged;
  }
};

const Method<Merson> registered{
    {.name = "merson-4",
     .title = "Merson's method of order 4",
     .reference = "hairer-norsett-wanner1993 II.4",
     .description = "An explicit Runge-Kutta method of order 4 with five stages. It keeps no structure.",
     .order = 4,
     .preserves = {Claim::none}}};
}  // namespace
