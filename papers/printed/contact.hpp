// Pitanga & Rodrigues 4.2 as printed: a free particle with w = dz - y dx, (36) to (40). Positions are (x, y,
// z).
#pragma once

#include <pfaff/papers/printed/dense.hpp>

namespace pfaff::printed {

template <class T>
struct ContactFormulas {
  T y;
  T d = T(1) + y * y;

  /// The metric in {dx, dy, w} and its inverse in {X_1, X_2, Y_3}.
  [[nodiscard]] Table<T> metric() const { return {{d, T(0), y}, {T(0), T(1), T(0)}, {y, T(0), T(1)}}; }
  [[nodiscard]] Table<T> inverse_metric() const {
    return {{T(1), T(0), T(0) - y}, {T(0), T(1), T(0)}, {T(0) - y, T(0), d}};
  }
  /// G(w, w), the vector xi = X^Q, and what is called its norm.
  [[nodiscard]] T g() const { return d; }
  [[nodiscard]] std::vector<T> xi() const { return {T(0) - y, T(0), T(1)}; }
  [[nodiscard]] T norm_of_xi() const { return d; }
  /// Q as printed in dx (x) d/dz and so on: the entry of dz^j (x) d/dz^i in row i. Its first term is given.
  [[nodiscard]] Table<T> expansion(std::size_t first_row) const {
    Table<T> q = zero_table<T>(3, 3);
    q[first_row][0] = q[first_row][0] + y * y / d;
    q[2][0] = q[2][0] - y / d;
    q[0][2] = q[0][2] - y / d;
    q[2][2] = q[2][2] + T(1) / d;
    return q;
  }
  /// The matrices Q, P, q and U.
  [[nodiscard]] Table<T> q() const {
    return {{y * y / d, T(0), T(0) - y / d}, {T(0), T(0), T(0)}, {T(0) - y / d, T(0), T(1) / d}};
  }
  [[nodiscard]] Table<T> p() const {
    return {{T(1) / d, T(0), y / d}, {T(0), T(1), T(0)}, {y / d, T(0), y * y / d}};
  }
  [[nodiscard]] Table<T> small_q() const {
    return {{T(0), T(0), T(0)}, {T(0), T(0), T(0)}, {T(0) - y, T(0), T(1)}};
  }
  [[nodiscard]] Table<T> u() const { return {{d, T(0), T(0) - y}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}; }
  /// X_1, X_2 and X^q.
  [[nodiscard]] std::vector<T> x1() const { return {T(1), T(0), y}; }
  [[nodiscard]] static std::vector<T> x2() { return {T(0), T(1), T(0)}; }
  [[nodiscard]] static std::vector<T> x_q() { return {T(0), T(0), T(1)}; }

  /// (36).
  [[nodiscard]] T constraint(const std::vector<T>& v) const { return v[2] - y * v[0]; }
  /// (38): x'' + y z'' and y'', which vanish.
  [[nodiscard]] std::vector<T> momentum_equation(const std::vector<T>& a) const {
    return {a[0] + y * a[2], a[1]};
  }
  /// After (38), the equations of Bates and Sniatycki: x'' + y x' y' / (1 + y^2) and y''.
  [[nodiscard]] std::vector<T> bates_sniatycki(const std::vector<T>& v, const std::vector<T>& a) const {
    return {a[0] + y / d * v[0] * v[1], a[1]};
  }
  /// The columns of (40), five of them, one after the other; momenta with p_z = y p_x.
  [[nodiscard]] std::vector<std::vector<T>> columns(const T& px) const {
    const T o(0), e(1);
    return {{o, o, o, o - e / d, o, o - y / d},
            {o, o, o, o, o - e, o},
            {o, o, o, o - y / d, o, o - y * y / d},
            {e / d, o, y / d, o, y * px / d, o},
            {o, e, o, o - y * px / d, o, px / d}};
  }
  /// The sixth column, missing there.
  [[nodiscard]] std::vector<T> sixth_column(const T& px) const {
    return {y / d, T(0), y * y / d, T(0), T(0) - px / d, T(0)};
  }
};

}  // namespace pfaff::printed
