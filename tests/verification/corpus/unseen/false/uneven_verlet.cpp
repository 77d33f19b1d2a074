// Stoermer and Verlet's method, which goes over to a splitting with other lengths in the course of a run.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.5 (splittings of order 2).
//
// False: `symmetric` holds for the first 40 steps; later ones are drift 1/4, kick 2/3, drift 3/4, kick 1/3,
// which is symplectic and of order 2 too, and no palindrome.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct UnevenVerlet {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> slope;
    int taken = 0;
    Work(const UnevenVerlet& /*method*/, const P& p) : slope(p.make_state()) {}
  };

  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (w.taken < 40) {
      ++w.taken;
      drift(p, t, h / T(2), z, w);
      kick(p, t + h / T(2), h, z, w);
      drift(p, t + h, h / T(2), z, w);
    } else {
      drift(p, t, h / T(4), z, w);
      kick(p, t + h / T(4), T(2) * h / T(3), z, w);
      drift(p, t + T(2) * h / T(3), T(3) * h / T(4), z, w);
      kick(p, t + h, h / T(3), z, w);
    }
    return Status::converged;
  }

 private:
  // The times are those of the other part: drifts advance that of V, kicks that of T.
  template <class P>
  void drift(const P& p, const Scalar<P>& t, const Scalar<P>& length, State<P>& z, Work<P>& w) const {
    const std::size_t half = z.size() / 2;
    const Out<Scalar<P>> momentum(z.data() + half, half), slope(w.slope.data(), half);
    p.velocity(t, momentum, slope);
    for (std::size_t k = 0; k < half; ++k) z[k] = z[k] + length * slope[k];
  }
  template <class P>
  void kick(const P& p, const Scalar<P>& t, const Scalar<P>& length, State<P>& z, Work<P>& w) const {
    const std::size_t half = z.size() / 2;
    const Out<Scalar<P>> q(z.data(), half), slope(w.slope.data(), half);
    p.force(t, q, slope);
    for (std::size_t k = 0; k < half; ++k) z[half + k] = z[half + k] + length * slope[k];
  }
};

const Method<UnevenVerlet> registered{
    {.name = "uneven-verlet",
     .title = "splittings of order 2, one after the other",
     .reference = "hairer-lubich-wanner2006 II.5",
     .description = "Explicit splittings of order 2 with one or two forces a step. Take them for separable "
                    "energies. They keep no force between steps.",
     .order = 2,
     .preserves = {Claim::symplectic, Claim::symmetric}}};
}  // namespace
