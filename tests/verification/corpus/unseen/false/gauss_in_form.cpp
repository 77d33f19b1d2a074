// Gauss collocation with two stages for Birkhoffian systems, in their own coordinates.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, II.1.3 and VI.4.
//
// False: `K-symplectic` holds where K is constant; where it depends on the time or the state, as with
// friction or in a magnetic field, what a step changes of K differs from what the flow does by h^5.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct GaussInForm {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    std::array<State<P>, 2> stage, rate;
    Work(const GaussInForm& /*method*/, const P& p)
        : stage{p.make_state(), p.make_state()}, rate{p.make_state(), p.make_state()} {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const T quarter = T(1) / T(4), root = sqrt(T(3)) / T(6), half = T(1) / T(2);
    const std::array<T, 2> node{half - root, half + root};
    p.field(t, z, w.rate[0]);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < z.size(); ++k) w.stage[i][k] = z[k] + node[i] * h * w.rate[0][k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t i = 0; i < 2; ++i) p.field(t + node[i] * h, w.stage[i], w.rate[i]);
      convergence.begin_iteration();
      for (std::size_t i = 0; i < 2; ++i) {
        const T other = i == 0 ? quarter - root : quarter + root;
        for (std::size_t k = 0; k < z.size(); ++k) {
          const T corrected = z[k] + h * (quarter * w.rate[i][k] + other * w.rate[1 - i][k]);
          convergence.add(corrected - w.stage[i][k], z[k], corrected);
          w.stage[i][k] = corrected;
        }
      }
    } while (!convergence.finished(200));
    if (convergence.status() != Status::converged) return convergence.status();
    for (std::size_t i = 0; i < 2; ++i) p.field(t + node[i] * h, w.stage[i], w.rate[i]);
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = z[k] + h * half * (w.rate[0][k] + w.rate[1][k]);
    return Status::converged;
  }
};

const Method<GaussInForm> registered{
    {.name = "gauss-in-form",
     .title = "Gauss collocation with two stages",
     .reference = "hairer-lubich-wanner2006 VI.4",
     .description = "Gauss collocation of order 4 by functional iteration. Take it for Birkhoffian systems "
                    "that are not stiff. Steps must be short enough for the iteration.",
     .order = 4,
     .preserves = {Claim::k_symplectic, Claim::symmetric}}};
}  // namespace
