// Pitanga & Rodrigues 4.1 as printed: the Chaplygin-Caratheodory sleigh of mass 1, (27) to (35). T is Quad or
// a dual over it; positions are (x, y, theta).
#pragma once

#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/papers/printed/dense.hpp>

namespace pfaff::printed {

template <class T>
struct SleighFormulas {
  T theta, inertia, distance;  // theta, J, r
  T s = sin(theta), c = cos(theta);

  /// (27) and (28): the components of the contact point's velocity along the blade and across it.
  [[nodiscard]] T along(const std::vector<T>& v) const { return v[0] * c + v[1] * s; }
  [[nodiscard]] T across(const std::vector<T>& v) const {
    return T(0) - distance * v[2] + v[1] * c - v[0] * s;
  }
  /// (30).
  [[nodiscard]] T displaced(const std::vector<T>& d) const {
    return T(0) - distance * d[2] + c * d[1] - s * d[0];
  }
  /// (31).
  [[nodiscard]] std::vector<T> row() const { return {T(0) - s, c, T(0) - distance}; }
  /// (32).
  [[nodiscard]] T lagrangian(const std::vector<T>& v) const {
    return (v[0] * v[0] + v[1] * v[1] + inertia * v[2] * v[2]) / T(2);
  }
  /// (33).
  [[nodiscard]] Table<T> metric() const {
    Table<T> g = unit_table<T>(3);
    g[2][2] = inertia;
    return g;
  }
  /// Before Remark 2, and in (34).
  [[nodiscard]] Table<T> q() const {
    const T r = distance, f = inertia / (inertia + r * r), zero(0);
    Table<T> m{{s * s, zero - c * s, r * s},
               {zero - c * s, c * c, zero - r * c},
               {r * s / inertia, zero - r * c / inertia, r * r / inertia}};
    for (auto& line : m)
      for (T& x : line) x = f * x;
    return m;
  }
  /// Remark 2: alpha, X and G = alpha(X).
  [[nodiscard]] std::vector<T> alpha() const { return row(); }
  [[nodiscard]] std::vector<T> x() const { return {T(0) - s, c, T(0) - distance / inertia}; }
  [[nodiscard]] T g() const { return (inertia + distance * distance) / inertia; }
  /// (35): omega' and u' from u and omega.
  [[nodiscard]] std::vector<T> rates(const T& u, const T& omega) const {
    return {T(0) - distance / (inertia + distance * distance) * u * omega, distance * omega * omega};
  }
  /// After (35): the constraint and H of the momenta.
  [[nodiscard]] T momentum_constraint(const std::vector<T>& p) const {
    return c * p[1] - s * p[0] - distance / inertia * p[2];
  }
  [[nodiscard]] T hamiltonian(const std::vector<T>& p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] / inertia) / T(2);
  }
};

}  // namespace pfaff::printed
