// The partitioned pair of Lobatto IIIA for the positions and Lobatto IIIB for the momenta with three stages,
// for energies H = T(p, t) + V(q, t): symplectic, symmetric and of order 4. With two stages it would be the
// method of Stoermer and Verlet.
//
// Source: Jay, Symplectic partitioned Runge-Kutta methods for constrained Hamiltonian systems, SIAM J. Numer.
// Anal. 33 (1996) 368; Hairer, Lubich, Wanner, Geometric Numerical Integration, II.2.2 and VI.4.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct LobattoPair {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    std::array<State<P>, 3> stage, next, rate;  // (Q_i, P_i) and (T_p(P_i), F(Q_i))
    Work(const LobattoPair& /*method*/, const P& p) {
      for (std::size_t i = 0; i < 3; ++i) stage[i] = next[i] = rate[i] = p.make_state();
    }
  };

  template <HasSeparable P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size(), m = n / 2;
    const std::array<T, 3> node{T(0), T(1) / T(2), T(1)}, weight{T(1) / T(6), T(2) / T(3), T(1) / T(6)};
    const std::array<std::array<T, 3>, 3> a{{{T(0), T(0), T(0)},
                                             {T(5) / T(24), T(1) / T(3), T(-1) / T(24)},
                                             {T(1) / T(6), T(2) / T(3), T(1) / T(6)}}},
        b{{{T(1) / T(6), T(-1) / T(6), T(0)},
           {T(1) / T(6), T(1) / T(3), T(0)},
           {T(1) / T(6), T(5) / T(6), T(0)}}};
    for (State<P>& s : w.stage)
      for (std::size_t k = 0; k < n; ++k) s[k] = z[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      rates(p, t, h, node, m, w);
      convergence.begin_iteration();
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < n; ++k) {
          const auto& row = k < m ? a[i] : b[i];
          const T found = z[k] + h * (row[0] * w.rate[0][k] + row[1] * w.rate[1][k] + row[2] * w.rate[2][k]);
          convergence.add(found - w.stage[i][k], z[k], found);
          w.stage[i][k] = found;
        }
    } while (!convergence.finished(300));
    if (convergence.status() != Status::converged) return convergence.status();
    rates(p, t, h, node, m, w);
    for (std::size_t k = 0; k < n; ++k)
      z[k] = z[k] + h * (weight[0] * w.rate[0][k] + weight[1] * w.rate[1][k] + weight[2] * w.rate[2][k]);
    return Status::converged;
  }

 private:
  template <class P>
  static void rates(const P& p, const Scalar<P>& t, const Scalar<P>& h, const std::array<Scalar<P>, 3>& node,
                    std::size_t m, Work<P>& w) {
    using T = Scalar<P>;
    for (std::size_t i = 0; i < 3; ++i) {
      const T time = t + node[i] * h;
      p.velocity(time, In<T>(w.stage[i].data() + m, m), Out<T>(w.rate[i].data(), m));
      p.force(time, In<T>(w.stage[i].data(), m), Out<T>(w.rate[i].data() + m, m));
    }
  }
};

const Method<LobattoPair> registered{
    {.name = "lobatto-pair-4",
     .title = "Lobatto IIIA and IIIB with three stages for separable energies",
     .reference = "hairer-lubich-wanner2006 II.2.2",
     .description = "An implicit partitioned method, symplectic and symmetric. Take it as the next member of "
                    "the family that "
                    "begins with Stoermer and Verlet's method.",
     .order = 4,
     .preserves = {Claim::symplectic, Claim::symmetric, Claim::momentum_maps}}};
}  // namespace
