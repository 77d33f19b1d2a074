// Conformal splitting, D(h/2) S(h) D(h/2) with D the flow of the friction and S the method of Stoermer and
// Verlet, with a series for the exponential.
//
// Source: McLachlan, Perlmutter 2001; Bhatt, Floyd, Moore 2016.
//
// False: `conformal`: the series of e^{-x}, x = nu h/2, ends with x^9, so that the decay is off by x^10/10!,
// which is 3e-10 for x = 1/2 and less than round-off in double for x < 1/8.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct TruncatedFriction {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> slope;
    Work(const TruncatedFriction& /*method*/, const P& p) : slope(p.make_state()) {}
  };

  template <HasConformal P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t half = z.size() / 2;
    const Out<T> q(z.data(), half), momentum(z.data() + half, half), slope(w.slope.data(), half);
    const T x = -(p.damping() * h / T(2));
    T factor(1);
    for (int k = 9; k > 0; --k) factor = T(1) + factor * x / T(k);
    for (std::size_t k = 0; k < half; ++k) momentum[k] = factor * momentum[k];
    p.undamped_velocity(t, momentum, slope);
    for (std::size_t k = 0; k < half; ++k) q[k] = q[k] + h / T(2) * slope[k];
    p.undamped_force(t + h / T(2), q, slope);
    for (std::size_t k = 0; k < half; ++k) momentum[k] = momentum[k] + h * slope[k];
    p.undamped_velocity(t + h, momentum, slope);
    for (std::size_t k = 0; k < half; ++k) q[k] = q[k] + h / T(2) * slope[k];
    for (std::size_t k = 0; k < half; ++k) momentum[k] = factor * momentum[k];
    return Status::converged;
  }
};

const Method<TruncatedFriction> registered{
    {.name = "truncated-friction",
     .title = "conformal splitting of order 2",
     .reference = "bhatt2016",
     .description = "A splitting into linear friction and a symplectic step. Take it for weak friction over "
                    "long times. Its exponential is a short series.",
     .order = 2,
     .preserves = {Claim::conformal}}};
}  // namespace
