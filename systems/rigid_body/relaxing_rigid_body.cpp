// A rigid body that relaxes at constant energy, in the body frame: z = angular momentum, Omega_a = z_a/I_a,
// a metriplectic system with energy and entropy (morrison1986).
//
//   H = sum z_a^2/(2 I_a),   S = |z|^2/2,   z' = Pi dH + G dS
//   Pi: the Lie-Poisson bracket of so(3)*, of which S is a Casimir, Pi dS = 0
//   G = alpha (|Omega|^2 I - Omega Omega^T), symmetric, non-negative, G dH = 0
//   z' = z x Omega + alpha Omega x (z x Omega)
//
// The energy is conserved exactly, the entropy grows until z x Omega = 0: the body ends up turning about a
// principal axis, from almost everywhere that of the largest moment of inertia, which has the largest |z| of
// a given energy. Closed form for I_1 = I_2: with I = I_1, J = I_3, d = 1/I - 1/J and E the energy,
//   z_3^2 = 2 E J/(1 + c e^{-4 E alpha d t}),   c = 2 E J/z_3(0)^2 - 1,
// while (z_1, z_2) turns.
#include <array>

#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

/// scale (|w|^2 I - w w^T) with w_a = z_a/I_a.
struct RelaxationBracket {
  std::array<Real, 3> moments;
  Real scale;
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    std::array<T, 3> w{z[0] / moments[0], z[1] / moments[1], z[2] / moments[2]};
    const T square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
    const T along = w[0] * covector[0] + w[1] * covector[1] + w[2] * covector[2];
    for (std::size_t a = 0; a < 3; ++a) vector[a] = scale * (square * covector[a] - w[a] * along);
  }
};

struct RelaxingRigidBody {
  static constexpr int dimension = 3;
  Real i1 = 2, i2 = 1, i3 = Real::fraction(2, 3), alpha = 0.2_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&RelaxingRigidBody::i1, "i1", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&RelaxingRigidBody::i2, "i2", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&RelaxingRigidBody::i3, "i3", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&RelaxingRigidBody::alpha, "alpha", "s", 0, 1e3, "strength of the relaxation")};
  }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    const auto behaviour = alpha.is(0) ? Behaviour::conserved : Behaviour::increasing;
    return {conserved_quadratic("energy", "J"), {"entropy", "kg^2 m^4/s^2", behaviour, alpha.is(0)}};
  }
  [[nodiscard]] LiePoissonBracket bracket() const { return LiePoissonBracket::rigid_body(); }
  [[nodiscard]] RelaxationBracket symmetric_bracket() const { return {{i1, i2, i3}, alpha}; }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] / i1 + z[1] * z[1] / i2 + z[2] * z[2] / i3) / 2;
  }
  template <class T>
  T entropy(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]) / 2;
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const std::array<T, 3> w{z[0] / i1, z[1] / i2, z[2] / i3};
    std::array<T, 3> free;
    for (std::size_t a = 0; a < 3; ++a)
      free[a] = z[(a + 1) % 3] * w[(a + 2) % 3] - z[(a + 2) % 3] * w[(a + 1) % 3];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
      rate[a] = free[a] + alpha * (w[b] * free[d] - w[d] * free[b]);
    }
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = entropy(t, z);
  }
};

const System<RelaxingRigidBody> registered{
    {.name = "relaxing-rigid-body",
     .title = "rigid body relaxing at constant energy, z' = z x Omega + alpha Omega x (z x Omega)",
     .reference = "morrison1986",
     .description = "A rigid body that relaxes at constant energy, a metriplectic system with an energy and "
                    "an entropy that grows. Take it to test whether methods keep the one and raise the "
                    "other; there is a closed form for symmetric bodies. The relaxation is a model of the "
                    "structure and not of a particular material.",
     .coordinates = {{"z1", "kg m^2/s"}, {"z2", "kg m^2/s"}, {"z3", "kg m^2/s"}},
     .initial = {Real::fraction(9, 10), Real::fraction(1, 5), Real::fraction(3, 5)}}};
}  // namespace
