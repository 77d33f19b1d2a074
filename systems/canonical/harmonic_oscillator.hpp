// The harmonic oscillator, H = (p^2 + omega^2 q^2)/2, unit mass.
#pragma once

#include <vector>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace pfaff {

struct HarmonicOscillator {
  static constexpr int dimension = 2;
  Real omega = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&HarmonicOscillator::omega, "omega", "1/s", 1e-3, 1e3, "angular frequency")};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  // omega (omega x), not omega^2 x: a product of two parameters is exact arithmetic, slow inside a formula.
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return omega * (omega * (q[0] * q[0])) / 2;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    f[0] = -(omega * (omega * q[0]));
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = p[0];
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = (z[1] * z[1] + omega * (omega * (z[0] * z[0]))) / 2;
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T c = cos(omega * elapsed), s = sin(omega * elapsed);
    z[0] = z0[0] * c + z0[1] * s / omega;
    z[1] = z0[1] * c - z0[0] * s * omega;
  }
};

}  // namespace pfaff
