// Ralston's explicit Runge-Kutta method of order 3: nodes 1/2 and 3/4, weights 2/9, 1/3, 4/9. Keeps no
// structure.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct Ralston {
  template <class P>
  struct Work {
    State<P> a, b, c, point;
    Work(const Ralston& /*method*/, const P& p)
        : a(p.make_state()), b(p.make_state()), c(p.make_state()), point(p.make_state()) {}
  };
  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    p.field(t, z, w.a);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + h * w.a[k] / 2;
    p.field(t + h / 2, w.point, w.b);
    for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + 3 * h * w.b[k] / 4;
    p.field(t + 3 * h / 4, w.point, w.c);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * (2 * w.a[k] + 3 * w.b[k] + 4 * w.c[k]) / 9;
    return Status::converged;
  }
};

const Method<Ralston> registered{
    {.name = "ralston",
     .title = "Ralston's method of order 3",
     .reference = "ralston1962",
     .description = "Ralston's explicit Runge-Kutta method of order 3, the example of an integrator outside "
                    "the tree. Take it as a start for a method of your own. It keeps no structure.",
     .order = 3,
     .preserves = {Claim::none}}};
}  // namespace
