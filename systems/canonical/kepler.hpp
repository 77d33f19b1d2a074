// The planar Kepler problem, H = |p|^2/2 - 1/|q|, started at the pericentre of an ellipse of eccentricity e
// and unit semi-major axis (period 2 pi). Energy, angular momentum and the Laplace-Runge-Lenz vector are
// conserved.
#pragma once

#include <vector>

#include <pfaff/core/numbers/elliptic.hpp>
#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace pfaff {

struct Kepler {
  static constexpr int dimension = 4;
  Real eccentricity = 0.6_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&Kepler::eccentricity, "eccentricity", "", 0, 0.95,
                      "of the orbit at the start; any other start is set by initial=")};
  }
  static std::vector<Assignments> instances(bool /*full*/) { return {{}, {{"eccentricity", "0.6"}}}; }
  template <class T>
  void initial(Out<T> z) const {
    z[0] = T(Real(1) - eccentricity);
    z[3] = T(sqrt((Real(1) + eccentricity) / (Real(1) - eccentricity)));
  }

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -1 / sqrt(q[0] * q[0] + q[1] * q[1]);
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    const T square = q[0] * q[0] + q[1] * q[1];
    const T scale = -1 / (square * sqrt(square));
    f[0] = scale * q[0];
    f[1] = scale * q[1];
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = p[0];
    v[1] = p[1];
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const In<T> q = z.first(2), p = z.subspan(2);
    const T inverse = 1 / sqrt(q[0] * q[0] + q[1] * q[1]);
    const T momentum = q[0] * p[1] - q[1] * p[0];
    values[0] = kinetic(t, p) + potential(t, q);
    values[1] = momentum;
    values[2] = p[1] * momentum - q[0] * inverse;
    values[3] = -(p[0] * momentum) - q[1] * inverse;
  }
  // Kepler's equation for the difference x = E - E0 of the eccentric anomalies, n s = x - c sin x + d (1 -
  // cos x) with c = e cos E0, d = e sin E0, then the f and g functions (battin1999 (4.29), (4.41)). Newton's
  // method on it wanders from some starts (one in a hundred for e = 0.95). Laguerre's method for E itself
  // does not: it is within 1e-12 after four steps for e <= 0.99, whatever the mean anomaly (conway1986), and
  // Newton's is left the last digits. Elliptic orbits only: NaN for the others.
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T r0 = sqrt(z0[0] * z0[0] + z0[1] * z0[1]);
    const T a = 1 / (2 / r0 - (z0[2] * z0[2] + z0[3] * z0[3]));
    const T root = sqrt(a);
    const T c = 1 - r0 / a, d = (z0[0] * z0[2] + z0[1] * z0[3]) / root;
    const T n = 1 / (a * root), mean = n * elapsed;
    const T square = c * c + d * d, size = sqrt(select(square, square, T(1))), e = select(square, size, T(0));
    const T start = select(square, angle_of(c / size, d / size), T(0));
    const T anomaly = start - d + mean;
    T x = anomaly + e * sin(anomaly);
    for (int iteration = 0; iteration < 5; ++iteration) {
      const T curvature = e * sin(x), slope = 1 - e * cos(x), value = x - curvature - anomaly;
      const T discriminant = 16 * slope * slope - 20 * value * curvature;
      x = x - 5 * value / (slope + sqrt(select(discriminant, discriminant, -discriminant)));
    }
    x = x - start;
    for (int iteration = 0; iteration < 2; ++iteration) {
      const T s = sin(x), k = cos(x);
      x = x - (x - c * s + d * (1 - k) - mean) / (1 - c * k + d * s);
    }
    const T s = sin(x), k = 1 - cos(x);
    const T f = 1 - a / r0 * k, g = elapsed + (s - x) / n;
    const T r = a * (1 - c * (1 - k) + d * s);
    const T f_rate = -(a * a * n * s) / (r * r0), g_rate = 1 - a / r * k;
    for (std::size_t i = 0; i < 2; ++i) {
      z[i] = f * z0[i] + g * z0[2 + i];
      z[2 + i] = f_rate * z0[i] + g_rate * z0[2 + i];
    }
  }
};

}  // namespace pfaff
