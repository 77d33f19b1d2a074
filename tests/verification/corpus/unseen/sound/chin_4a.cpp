// Chin's method 4A for energies H = p^T M^-1 p/2 + V(q, t) with constant masses: three kicks and two drifts,
// all forwards in time, the middle kick with a modified force. It is symplectic, symmetric and of order 4.
//
//   kick(h/6) drift(h/2) kick*(2 h/3) drift(h/2) kick(h/6),   F* = F + h^2/24 F_q M^-1 F
//
// F* is the force of the potential V - h^2/48 V_q M^-1 V_q.
//
// Source: Chin, Symplectic integrators from composite operator factorizations, Phys. Lett. A 226 (1997) 344.
#include <pfaff/core/facets/quadratic_energy.hpp>
#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct Chin {
  static constexpr bool fixed_sizes = false;
  std::array<Quad, 4> lengths{Quad(1) / Quad(6), Quad(2) / Quad(3), Quad(1) / Quad(2), Quad(1) / Quad(24)};
  std::span<Quad> coefficients() { return lengths; }

  [[nodiscard]] std::string refuses(const Model& model) const {
    return quadratic_in_momenta(model) && steady_kinetic_energy(model)
               ? ""
               : "needs a kinetic energy that is quadratic in the momenta and does not depend on time";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T outer, middle, drift, correction;
    std::vector<T> jacobian;
    State<P> force, velocity, along, carry;
    Work(const Chin& method, const P& p)
        : outer(Real(method.lengths[0])),
          middle(Real(method.lengths[1])),
          drift(Real(method.lengths[2])),
          correction(Real(method.lengths[3])),
          jacobian(p.size() * p.size()),
          force(p.make_state()),
          velocity(p.make_state()),
          along(p.make_state()),
          carry(p.make_state()) {}
  };

  template <HasSeparable P>
  requires HasFieldJacobian<P> Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z,
                                           Work<P>& w)
  const {
    using T = Scalar<P>;
    const std::size_t n = z.size(), m = n / 2;
    const T half = t + h / T(2);
    kick(p, t, w.outer * h, z, w);
    drift(p, t, w.drift * h, z, w);
    // F* at the middle: the Jacobian of the field has M^-1 in its upper right block and F_q in the lower left
    // one.
    p.force(half, In<T>(z.data(), m), Out<T>(w.force.data(), m));
    p.field_jacobian(half, z, w.jacobian);
    for (std::size_t i = 0; i < m; ++i) {
      w.along[i] = T(0);
      for (std::size_t j = 0; j < m; ++j) w.along[i] = w.along[i] + w.jacobian[i * n + m + j] * w.force[j];
    }
    for (std::size_t i = 0; i < m; ++i) {
      T bend(0);
      for (std::size_t j = 0; j < m; ++j) bend = bend + w.jacobian[(m + i) * n + j] * w.along[j];
      compensated_add(z[m + i], w.carry[m + i], T(w.middle * h * (w.force[i] + w.correction * h * h * bend)));
    }
    drift(p, t, w.drift * h, z, w);
    kick(p, t + h, w.outer * h, z, w);
    return Status::converged;
  }

 private:
  template <class P>
  static void kick(const P& p, const Scalar<P>& time, const Scalar<P>& length, State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t m = z.size() / 2;
    p.force(time, In<T>(z.data(), m), Out<T>(w.force.data(), m));
    for (std::size_t i = 0; i < m; ++i) compensated_add(z[m + i], w.carry[m + i], T(length * w.force[i]));
  }
  template <class P>
  static void drift(const P& p, const Scalar<P>& time, const Scalar<P>& length, State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t m = z.size() / 2;
    p.velocity(time, In<T>(z.data() + m, m), Out<T>(w.velocity.data(), m));
    for (std::size_t i = 0; i < m; ++i) compensated_add(z[i], w.carry[i], T(length * w.velocity[i]));
  }
};

const Method<Chin> registered{{.name = "chin-4a",
                               .title = "Chin's forward method 4A with a modified force",
                               .reference = "omelyan-mryglod-folk2002",
                               .description = "A symplectic and symmetric method of order 4 without backward "
                                              "steps, for constant masses. Take it where "
                                              "second derivatives of the potential are cheap.",
                               .order = 4,
                               .preserves = {Claim::symplectic, Claim::symmetric, Claim::momentum_maps}}};
}  // namespace
