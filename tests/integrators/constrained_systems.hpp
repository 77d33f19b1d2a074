// Systems with constraints that are made for tests: small, and without symmetries that could hide errors.
#pragma once

#include <pfaff/core/system.hpp>

namespace pfaff::constrained {

/// A bead on a sphere of radius 1 in a field that is different in every direction.
struct BentSphere {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;
  Real drag = 0;      // friction coefficient
  bool fast = false;  // T = sqrt(1 + |p|^2) instead of |p|^2/2

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    const T square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    return fast ? sqrt(T(1) + square) : square / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return 3 * q[2] + q[0] * q[0] * q[1] + q[1] * sin(t);
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - 1) / 2;
  }
  template <class T>
  void friction(const T& /*t*/, In<T> /*z*/, Out<T> lambda) const {
    for (T& x : lambda) x = T(drag);
  }
};

/// The same without time.
struct StillSphere : BentSphere {
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return 3 * q[2] + q[0] * q[0] * q[1];
  }
};

/// The same sphere, with a mass that depends on the position: H = (1 + q_x^2) |p|^2 / 2 + V.
struct UnevenSphere {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;

  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (1 + z[0] * z[0]) * (z[3] * z[3] + z[4] * z[4] + z[5] * z[5]) / 2 + 3 * z[2];
  }
  template <class T>
  void holonomic(const T& t, In<T> q, Out<T> phi) const {
    BentSphere().holonomic(t, q, phi);
  }
};

template <class S>
std::shared_ptr<const Model> on_sphere(const S& system) {
  return make_model(
      SystemDescriptor{
          .name = "sphere-of-a-test",
          .title = "a bead on a sphere",
          .reference = "landau-lifshitz1976",
          .coordinates = {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"px", "m/s"}, {"py", "m/s"}, {"pz", "m/s"}},
          .initial = {Real::fraction(6, 10), 0, Real::fraction(-8, 10), Real::fraction(4, 10), 1,
                      Real::fraction(3, 10)}},
      system);
}

}  // namespace pfaff::constrained
