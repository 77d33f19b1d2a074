// Lobatto IIIA with three stages, the collocation method with nodes at both ends and in the middle of the
// step, of order 4: with f_0, f_1, f_2 at z, z_1, z_2,
//
//   z_1 = z + h (5 f_0 + 8 f_1 - f_2)/24,   z' = z_2 = z + h (f_0 + 4 f_1 + f_2)/6.
//
// Source: Ehle (1969); Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.4.
//
// False: the claim that it is symplectic. It is symmetric, and so it keeps energies of reversible systems
// near to what they were, but the condition b_i a_ij + b_j a_ji = b_i b_j fails for i = j = 1. Only together
// with Lobatto IIIB is it symplectic.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct LobattoCollocation {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    State<P> first, second, third, middle, end;
    Work(const LobattoCollocation& /*method*/, const P& p)
        : first(p.make_state()),
          second(p.make_state()),
          third(p.make_state()),
          middle(p.make_state()),
          end(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.first);
    for (std::size_t k = 0; k < z.size(); ++k) w.middle[k] = w.end[k] = z[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      p.field(t + h / T(2), w.middle, w.second);
      p.field(t + h, w.end, w.third);
      convergence.begin_iteration();
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T middle = z[k] + h * (T(5) * w.first[k] + T(8) * w.second[k] - w.third[k]) / T(24);
        const T end = z[k] + h * (w.first[k] + T(4) * w.second[k] + w.third[k]) / T(6);
        convergence.add(middle - w.middle[k], z[k], middle);
        convergence.add(end - w.end[k], z[k], end);
        w.middle[k] = middle;
        w.end[k] = end;
      }
    } while (!convergence.finished(300));
    if (convergence.status() == Status::converged)
      for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.end[k];
    return convergence.status();
  }
};

const Method<LobattoCollocation> registered{
    {.name = "lobatto-iiia-4",
     .title = "Lobatto IIIA with three stages",
     .reference = "hairer-lubich-wanner2006 II.1",
     .description = "A collocation method of order 4 with nodes at both ends of the step. Take it where the "
                    "solution between the steps is "
                    "needed as well.",
     .order = 4,
     .preserves = {Claim::symplectic, Claim::symmetric, Claim::reversible}}};
}  // namespace
