// Chin's method 4B for energies H = p^T M^-1 p/2 + V(q, t) with constant masses: drift, kick, drift, kick,
// drift, all forwards in time, both kicks with a modified force,
//
//   drift((1 - 1/sqrt 3)/2) kick*(1/2) drift(1/sqrt 3) kick*(1/2) drift((1 - 1/sqrt 3)/2)
//
// where F* = F + (2 - sqrt 3)/24 h^2 F_q M^-1 F.
//
// Source: Chin, Symplectic integrators from composite operator factorizations, Phys. Lett. A 226 (1997) 344.
//
// False: the order. The modified potential is V - (2 - sqrt 3)/24 h^2 V_q M^-1 V_q, whose force has twice the
// correction that is written here, since the square is differentiated. The method is of order 2. It is
// symplectic and symmetric with any such correction.
#include <pfaff/core/facets/quadratic_energy.hpp>
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct Chin {
  static constexpr bool fixed_sizes = false;

  [[nodiscard]] std::string refuses(const Model& model) const {
    return quadratic_in_momenta(model) && steady_kinetic_energy(model)
               ? ""
               : "needs a kinetic energy that is quadratic in the momenta and does not depend on time";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T outer, inner, correction;
    std::vector<T> jacobian;
    State<P> force, velocity, along, carry;
    Work(const Chin& /*method*/, const P& p)
        : jacobian(p.size() * p.size()),
          force(p.make_state()),
          velocity(p.make_state()),
          along(p.make_state()),
          carry(p.make_state()) {
      const T root = sqrt(T(3));
      inner = T(1) / root;
      outer = (T(1) - inner) / T(2);
      correction = (T(2) - root) / T(24);
    }
  };

  template <HasSeparable P>
  requires HasFieldJacobian<P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                           Work<P>& w)
  const {
    drift(p, t, w.outer * h, z, w);
    kick(p, t + w.outer * h, h, z, w);
    drift(p, t, w.inner * h, z, w);
    kick(p, t + (w.outer + w.inner) * h, h, z, w);
    drift(p, t, w.outer * h, z, w);
    return Status::converged;
  }

 private:
  // Half a kick with F*: the Jacobian of the field has M^-1 in its upper right block and F_q in the lower
  // left one.
  template <class P>
  static void kick(const P& p, const Scalar<P>& time, const Scalar<P>& h, State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = z.size(), m = n / 2;
    p.force(time, In<T>(z.data(), m), Out<T>(w.force.data(), m));
    p.field_jacobian(time, z, w.jacobian);
    for (std::size_t i = 0; i < m; ++i) {
      w.along[i] = T(0);
      for (std::size_t j = 0; j < m; ++j) w.along[i] = w.along[i] + w.jacobian[i * n + m + j] * w.force[j];
    }
    for (std::size_t i = 0; i < m; ++i) {
      T bend(0);
      for (std::size_t j = 0; j < m; ++j) bend = bend + w.jacobian[(m + i) * n + j] * w.along[j];
      compensated_add(z[m + i], w.carry[m + i], T(h / T(2) * (w.force[i] + w.correction * h * h * bend)));
    }
  }
  template <class P>
  static void drift(const P& p, const Scalar<P>& time, const Scalar<P>& length, State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t m = z.size() / 2;
    p.velocity(time, In<T>(z.data() + m, m), Out<T>(w.velocity.data(), m));
    for (std::size_t i = 0; i < m; ++i) compensated_add(z[i], w.carry[i], T(length * w.velocity[i]));
  }
};

const Method<Chin> registered{{.name = "chin-4b",
                               .title = "Chin's forward method 4B with two modified forces",
                               .reference = "omelyan-mryglod-folk2002",
                               .description = "A symplectic and symmetric method without backward steps, for "
                                              "constant masses. Take it where second derivatives of "
                                              "the potential are cheap.",
                               .order = 4,
                               .preserves = {Claim::symplectic, Claim::symmetric}}};
}  // namespace
