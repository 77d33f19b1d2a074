// Lawson's exponential method of order 4 for energies with friction: the friction is solved exactly, and
// the classical Runge-Kutta method steps in the variables (q, e^{nu t} p) that are left.
//
// Source: Lawson, SIAM J. Numer. Anal. 4 (1967) 372; Hochbruck, Ostermann, Acta Numerica 19 (2010) 209.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct Lawson {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> slope, point, sum, scaled;
    Work(const Lawson& /*method*/, const P& p)
        : slope(p.make_state()), point(p.make_state()), sum(p.make_state()), scaled(p.make_state()) {}
  };

  template <HasConformal P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const T half = exp(-p.damping() * h / T(2)), whole = half * half;
    for (std::size_t k = 0; k < z.size(); ++k) w.sum[k] = T(0);
    slopes(p, t, T(1), z, w);
    gather(z, w, h / T(2), h / T(6));
    slopes(p, t + h / T(2), half, w.point, w);
    gather(z, w, h / T(2), h / T(3));
    slopes(p, t + h / T(2), half, w.point, w);
    gather(z, w, h, h / T(3));
    slopes(p, t + h, whole, w.point, w);
    gather(z, w, h, h / T(6));
    for (std::size_t k = 0; k < z.size(); ++k) {
      z[k] = z[k] + w.sum[k];
      if (k >= z.size() / 2) z[k] = whole * z[k];
    }
    return Status::converged;
  }

 private:
  // q' and P' at (q, P), where p = decay P.
  template <class P>
  static void slopes(const P& p, const Scalar<P>& time, const Scalar<P>& decay, const State<P>& point,
                     Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = point.size() / 2;
    for (std::size_t k = n; k < 2 * n; ++k) w.scaled[k] = decay * point[k];
    p.undamped_velocity(time, In<T>(w.scaled.data() + n, n), Out<T>(w.slope.data(), n));
    p.undamped_force(time, In<T>(point.data(), n), Out<T>(w.slope.data() + n, n));
    for (std::size_t k = n; k < 2 * n; ++k) w.slope[k] = w.slope[k] / decay;
  }
  template <class P>
  static void gather(const State<P>& z, Work<P>& w, const Scalar<P>& reach, const Scalar<P>& weight) {
    for (std::size_t k = 0; k < z.size(); ++k) {
      w.point[k] = z[k] + reach * w.slope[k];
      w.sum[k] = w.sum[k] + weight * w.slope[k];
    }
  }
};

const Method<Lawson> registered{
    {.name = "lawson-4",
     .title = "Lawson's exponential Runge-Kutta method of order 4 for energies with friction",
     .reference = "hairer-lubich-wanner2006",
     .description = "The friction is solved exactly, the rest by the classical Runge-Kutta method. Take it "
                    "where friction is strong. It keeps no structure.",
     .order = 4,
     .preserves = {Claim::none}}};
}  // namespace
