// The free rigid body in the body frame, z = angular momentum, H = sum z_i^2 / (2 I_i) with the Lie-Poisson bracket of
// so(3)*: z' = z x I^-1 z. The Casimir |z|^2/2 and the energy are conserved, both quadratic.
#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct FreeRigidBody {
  static constexpr int dimension = 3;
  Real i1 = 2, i2 = 1, i3 = Real::fraction(2, 3);
  static std::vector<Parameter> parameters() {
    return {parameter(&FreeRigidBody::i1, "i1", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&FreeRigidBody::i2, "i2", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&FreeRigidBody::i3, "i3", "kg m^2", 1e-3, 1e3, "principal moment of inertia")};
  }
  [[nodiscard]] LiePoissonBracket bracket() const { return LiePoissonBracket::rigid_body(); }
  template <class T> T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] / i1 + z[1] * z[1] / i2 + z[2] * z[2] / i3) / 2;
  }
  template <class T> void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T w1 = z[0] / i1, w2 = z[1] / i2, w3 = z[2] / i3;
    rate[0] = z[1] * w3 - z[2] * w2;
    rate[1] = z[2] * w1 - z[0] * w3;
    rate[2] = z[0] * w2 - z[1] * w1;
  }
  template <class T> void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = (z[0] * z[0] + z[1] * z[1] + z[2] * z[2]) / 2;
  }
};

const System<FreeRigidBody> registered{
    {.name = "free-rigid-body",
     .title = "free rigid body, z' = z x I^-1 z, on so(3)*",
     .reference = "marsden-ratiu1999 (1.2.9); hairer-lubich-wanner2006 VII.5",
     .coordinates = {{"z1", "kg m^2/s"}, {"z2", "kg m^2/s"}, {"z3", "kg m^2/s"}},
     .initial = {Real::fraction(9, 10), 0, Real::fraction(3, 5)},
     .invariants = {conserved_quadratic("energy", "J"), conserved_quadratic("casimir", "kg^2 m^4/s^2")}}};
}  // namespace
