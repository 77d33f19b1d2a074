// Small systems with velocity constraints: those of the golden values, the contact particle, and one whose
// constraint is a holonomic one in disguise.
#pragma once

#include <pfaff/core/system.hpp>

namespace pfaff::testing {

struct WithoutParameters {
  static std::vector<Parameter> parameters() { return {}; }
};

/// L = |v|^2/2 - (|q|^2 + eps x^2 z^2)/2 with eps = 0.3, and x' + y z' = 0.
struct ContactOscillator : WithoutParameters {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + 3 * q[0] * q[0] * q[2] * q[2] / 10) / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = T(1);
    rows[2] = q[1];
  }
};

/// A knife edge of mass 1 and moment of inertia 1/2 on an incline with 4.9 m/s^2 along it.
struct KnifeEdge : WithoutParameters {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2 + p[2] * p[2];
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -49 * q[0] / 10;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = sin(q[2]);
    rows[1] = -cos(q[2]);
  }
};

/// m = 1, l = 1/2, J0 = 1/10, J1 = 1/20: momenta p_th = l^2 th' + J0 psi', p_psi = J0 (th' + psi').
struct Snakeboard : WithoutParameters {
  static constexpr int dimension = 10, velocity_constraint_count = 2;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    const T turn = p[2] - p[3];  // (l^2 - J0) th' = 3/20 th'
    return (p[0] * p[0] + p[1] * p[1]) / 2 + 10 * turn * turn / 3 + 5 * p[3] * p[3] + 5 * p[4] * p[4];
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2] + q[4]);
    rows[1] = cos(q[2] + q[4]);
    rows[2] = -cos(q[4]) / 2;
    rows[5] = -sin(q[2] - q[4]);
    rows[6] = cos(q[2] - q[4]);
    rows[7] = cos(q[4]) / 2;
  }
};

/// m = 1, J = 1/2, r = 2/5, at its contact point: the mass matrix depends on the angle.
struct ChaplyginSleigh : WithoutParameters {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T turn = z[5] + 2 * (sin(z[2]) * z[3] - cos(z[2]) * z[4]) / 5;  // J th'
    return (z[3] * z[3] + z[4] * z[4]) / 2 + turn * turn;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
  }
};

/// A free particle of unit mass with z' = y x'.
struct ContactParticle : WithoutParameters {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -q[1];
    rows[2] = T(1);
  }
};

/// A pendulum in space of mass 2: q.v = 0 times a factor that hides that it is the rate of |q|^2/2.
struct DisguisedPendulum : WithoutParameters {
  static constexpr int dimension = 6, velocity_constraint_count = 1;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 4;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return 2 * q[2] + q[0] * q[1];
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    for (std::size_t k = 0; k < 3; ++k) rows[k] = (2 + q[0]) * q[k];
  }
};
/// The same pendulum with its holonomic constraint undisguised.
struct OpenPendulum : WithoutParameters {
  static constexpr int dimension = 6, constraint_count = 1;
  template <class T>
  T kinetic(const T& t, In<T> p) const {
    return DisguisedPendulum{}.kinetic(t, p);
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return DisguisedPendulum{}.potential(t, q);
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - 1) / 2;
  }
};

template <class S>
std::shared_ptr<const Model> model_of(const char* name, std::vector<Real> initial = {}) {
  return make_model(
      SystemDescriptor{.name = name, .title = "", .reference = "", .initial = std::move(initial)}, S{});
}

}  // namespace pfaff::testing
