// The mathematical pendulum, H = p^2/2 - omega^2 cos q.
//
// Exact solution: x = sin q/2, y = p/(2 omega), z = cos q/2 move by x' = omega y z, y' = -omega x z, z' =
// -omega x y, Jacobi's functions (whittaker1937 section 44), from any state, swinging or revolving. Near the
// separatrix the problem itself limits its accuracy: a change d of the initial state grows to d e^{omega t}.
#pragma once

#include <vector>

#include <pfaff/core/numbers/elliptic.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace pfaff {

struct Pendulum {
  static constexpr int dimension = 2;
  Real omega = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&Pendulum::omega, "omega", "1/s", 1e-3, 1e3, "frequency of small swings")};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  // omega (omega x), not omega^2 x: a product of two parameters is exact arithmetic, slow inside a formula.
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -(omega * (omega * cos(q[0])));
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    f[0] = -(omega * (omega * sin(q[0])));
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
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(1)) + potential(t, z.first(1));
  }
  // The half angle q/2 follows from its sine and cosine without a jump: swinging, it stays within a right
  // angle of the multiple of pi it started near; revolving, within 180 degrees of its mean motion.
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T half = z0[0] / 2, x = sin(half), c = cos(half);
    const JacobiFlow<T> flow = jacobi_flow(omega * elapsed, JacobiState<T>{x, z0[1] / (2 * omega), c});
    const T expected = half + flow.mean, side = select(c, T(1), T(-1));
    const T sine = select(flow.revolving, sin(expected), T(0));
    const T cosine = select(flow.revolving, cos(expected), side);
    const JacobiState<T>& s = flow.state;
    const T turn = angle_of(s.z * cosine + s.x * sine, s.x * cosine - s.z * sine);
    const T before = angle_of(select(flow.revolving, T(1), side * c), select(flow.revolving, T(0), side * x));
    z[0] = z0[0] + 2 * (flow.mean + turn - before);
    z[1] = 2 * omega * s.y;
  }
};

}  // namespace pfaff
