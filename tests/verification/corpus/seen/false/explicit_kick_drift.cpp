// Symplectic Euler for any canonical system: a kick with p' at the old state, then a drift with q' at the
// new momenta.
//
// Source: de Vogelaere (1956); Hairer, Lubich, Wanner, Geometric Numerical Integration, (I.1.9) and VI.3.
//
// False: `symplectic` is claimed of all canonical systems and holds for H = T(p, t) + V(q, t) only.
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct ExplicitKickDrift {
  static constexpr bool fixed_sizes = false;

  [[nodiscard]] std::string refuses(const Model& model) const {
    return model.canonical() ? "" : "moves positions and momenta and needs a canonical system";
  }

  template <class P>
  struct Work {
    State<P> rate;
    Work(const ExplicitKickDrift& /*method*/, const P& p) : rate(p.make_state()) {}
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    const std::size_t n = z.size() / 2;
    p.field(t, z, w.rate);
    for (std::size_t k = n; k < 2 * n; ++k) z[k] = z[k] + h * w.rate[k];
    p.field(t, z, w.rate);
    for (std::size_t k = 0; k < n; ++k) z[k] = z[k] + h * w.rate[k];
    return Status::converged;
  }
};

const Method<ExplicitKickDrift> registered{
    {.name = "explicit-kick-drift",
     .title = "symplectic Euler: kick, then drift",
     .reference = "hairer-lubich-wanner2006 (I.1.9)",
     .description = "The simplest symplectic method. Take it to compare. Its order is 1.",
     .order = 1,
     .preserves = {Claim::symplectic}}};
}  // namespace
