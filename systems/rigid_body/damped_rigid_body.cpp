// A rigid body with double-bracket damping, in the body frame: z = angular momentum, Omega_a = z_a/I_a, a
// metriplectic system with a free energy (bloch-krishnaprasad-marsden-ratiu1996).
//
//   H = sum z_a^2/(2 I_a),   z' = Pi dH - G dH
//   Pi: the Lie-Poisson bracket of so(3)*;   G = alpha (|z|^2 I - z z^T), symmetric, non-negative
//   z' = z x Omega + alpha z x (z x Omega),   H' = -alpha |z x Omega|^2
//
// The energy falls while the Casimir |z|^2/2 is conserved, G dC = 0: the motion stays on its coadjoint orbit
// and ends, from almost everywhere, at rotation about the axis of the largest moment of inertia. It is the
// counterpart of a body that relaxes at constant energy. Closed form for I_1 = I_2: with I = I_1, J = I_3 and
// d = 1/I - 1/J,
//   z_3^2 = C^2/(1 + c e^{-2 alpha d C^2 t}),   C = |z|,   c = C^2/z_3(0)^2 - 1.
#include <array>

#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

/// scale (|z|^2 I - z z^T).
struct DoubleBracket {
  Real scale;
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const T square = z[0] * z[0] + z[1] * z[1] + z[2] * z[2];
    const T along = z[0] * covector[0] + z[1] * covector[1] + z[2] * covector[2];
    for (std::size_t a = 0; a < 3; ++a) vector[a] = scale * (square * covector[a] - z[a] * along);
  }
};

struct DampedRigidBody {
  static constexpr int dimension = 3;
  Real i1 = 2, i2 = 1, i3 = Real::fraction(2, 3), alpha = 0.2_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&DampedRigidBody::i1, "i1", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&DampedRigidBody::i2, "i2", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&DampedRigidBody::i3, "i3", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&DampedRigidBody::alpha, "alpha", "s/(kg m^2)", 0, 1e3, "strength of the damping")};
  }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    const auto behaviour = alpha.is(0) ? Behaviour::conserved : Behaviour::decreasing;
    return {{"energy", "J", behaviour, alpha.is(0)}, conserved_quadratic("casimir", "kg^2 m^4/s^2")};
  }
  [[nodiscard]] LiePoissonBracket bracket() const { return LiePoissonBracket::rigid_body(); }
  [[nodiscard]] DoubleBracket symmetric_bracket() const { return {alpha}; }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] / i1 + z[1] * z[1] / i2 + z[2] * z[2] / i3) / 2;
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const std::array<T, 3> w{z[0] / i1, z[1] / i2, z[2] / i3};
    std::array<T, 3> free;
    for (std::size_t a = 0; a < 3; ++a)
      free[a] = z[(a + 1) % 3] * w[(a + 2) % 3] - z[(a + 2) % 3] * w[(a + 1) % 3];
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
      rate[a] = free[a] + alpha * (z[b] * free[d] - z[d] * free[b]);
    }
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]) / 2;
  }
};

const System<DampedRigidBody> registered{
    {.name = "damped-rigid-body",
     .title = "rigid body with double-bracket damping, z' = z x Omega + alpha z x (z x Omega)",
     .reference = "bloch-krishnaprasad-marsden-ratiu1996",
     .description = "A rigid body with double-bracket damping, a metriplectic system with a free energy: the "
                    "energy falls while the length of the angular momentum stays. Take it to test methods on "
                    "dissipation that leaves a Casimir alone; there is a closed form for symmetric bodies. "
                    "It comes to rest at rotation about the axis of the largest moment of inertia.",
     .coordinates = {{"z1", "kg m^2/s"}, {"z2", "kg m^2/s"}, {"z3", "kg m^2/s"}},
     .initial = {Real::fraction(3, 2), Real::fraction(-1, 2), 1}}};
}  // namespace
