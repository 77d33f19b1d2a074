// Heun's Runge-Kutta method of three stages and order 3, with nodes 0, 1/3 and 2/3.
//
// Source: Heun, Z. Math. Phys. 45 (1900) 23; Hairer, Norsett, Wanner, Solving Ordinary Differential
// Equations I, II.1.
//
// False: `order` is not 3 in quad: 1/3 is a double, which leaves order 1 there, and nothing says so.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct HeunThirds {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> first, second, third, point;
    Scalar<P> node;
    Work(const HeunThirds& /*method*/, const P& p)
        : first(p.make_state()),
          second(p.make_state()),
          third(p.make_state()),
          point(p.make_state()),
          node(1.0 / 3) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.first);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + w.node * h * w.first[k];
    p.field(t + w.node * h, w.point, w.second);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + T(2) * w.node * h * w.second[k];
    p.field(t + T(2) * w.node * h, w.point, w.third);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * (w.first[k] + T(3) * w.third[k]) / T(4);
    return Status::converged;
  }
};

const Method<HeunThirds> registered{
    {.name = "heun-thirds",
     .title = "Heun's method of order 3",
     .reference = "hairer-norsett-wanner1993 II.1",
     .description = "An explicit method of three stages. Take it for short runs. It keeps no structure.",
     .order = 3,
     .preserves = {Claim::none}}};
}  // namespace
