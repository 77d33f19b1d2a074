// Constrained systems made in tests: small, without symmetry where it would hide errors.
#pragma once

#include <pfaff/core/system.hpp>

namespace pfaff::constrained {

/// A bead on the sphere |q| = l with a field that is not the same in any two directions.
struct SphericalPendulum {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;
  Real mass{1}, length{1}, gravity{Real::fraction(981, 100)};
  Real tilt{0};  // breaks the symmetry about the vertical

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / (T(2) * T(mass));
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return T(mass) * T(gravity) * q[2] + T(tilt) * q[0] * q[0] * q[1];
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - T(length) * T(length)) / T(2);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3)) + potential(t, z.first(3));
    values[1] = z[0] * z[4] - z[1] * z[3];
  }
};

inline std::shared_ptr<const Model> spherical_pendulum(const Real& tilt = Real(0)) {
  SphericalPendulum system;
  system.tilt = tilt;
  SystemDescriptor descriptor{
      .name = "spherical-pendulum-of-a-test",
      .title = "a bead on a sphere",
      .reference = "landau-lifshitz1976",
      .coordinates =
          {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"px", "kg m/s"}, {"py", "kg m/s"}, {"pz", "kg m/s"}},
      .initial = {Real::fraction(6, 10), Real(0), Real::fraction(-8, 10), Real::fraction(4, 10), Real(1),
                  Real::fraction(3, 10)}};
  descriptor.invariants = {conserved("energy", "J"), conserved_quadratic("Lz", "kg m^2/s")};
  if (!tilt.is(0)) descriptor.invariants.back().behaviour = Behaviour::free;
  return make_model(descriptor, system);
}

}  // namespace pfaff::constrained
