// Su & Qin, section 2 as printed, of a system whose F and B are polynomials of the state and of time.
#pragma once

#include <algorithm>

#include <pfaff/papers/printed/dense.hpp>
#include <pfaff/papers/printed/polynomial.hpp>

namespace pfaff::printed {

/// F_i and B in the variables z_0, .., z_{n-1} and, after these, t.
struct BirkhoffSystem {
  std::vector<Polynomial> f;
  Polynomial b;

  [[nodiscard]] std::size_t size() const { return f.size(); }
  /// K_ij of (5).
  [[nodiscard]] Polynomial k(std::size_t i, std::size_t j) const { return f[j].slope(i) - f[i].slope(j); }
  /// dB/dz_i + dF_i/dt, which (16) calls -D_i.
  [[nodiscard]] Polynomial g(std::size_t i) const { return b.slope(i) + f[i].slope(size()); }
  [[nodiscard]] Polynomial d(std::size_t i) const { return Polynomial() - g(i); }
};

template <class T>
Table<T> structure_at(const BirkhoffSystem& s, const std::vector<T>& zt) {
  Table<T> k = zero_table<T>(s.size(), s.size());
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = 0; j < s.size(); ++j) k[i][j] = s.k(i, j).at(zt);
  return k;
}
template <class T>
std::vector<T> right_side_at(const BirkhoffSystem& s, const std::vector<T>& zt) {
  std::vector<T> g;
  for (std::size_t i = 0; i < s.size(); ++i) g.push_back(s.g(i).at(zt));
  return g;
}
/// The left sides of (1) and (16), with the index of K that the velocity is contracted with: the first as
/// printed, the second corrected.
template <class T>
std::vector<T> equations_at(const BirkhoffSystem& s, const std::vector<T>& zt, const std::vector<T>& velocity,
                            bool first_index) {
  const Table<T> k = structure_at(s, zt), turned = transposed(k);
  std::vector<T> left = product(first_index ? turned : k, velocity);
  const std::vector<T> g = right_side_at(s, zt);
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = left[i] - g[i];
  return left;
}
/// The largest residual of each of the three conditions (8), for K and any D.
template <class T>
std::vector<T> self_adjointness_at(const BirkhoffSystem& s, const std::vector<Polynomial>& d,
                                   const std::vector<T>& zt) {
  std::vector<T> worst(3, T(0));
  const auto note = [&](std::size_t which, const Polynomial& residual) {
    const T value = residual.at(zt);
    worst[which] = std::max(worst[which], value < T(0) ? T(0) - value : value);
  };
  const std::size_t n = s.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      note(0, s.k(i, j) + s.k(j, i));
      note(2, s.k(i, j).slope(n) - d[i].slope(j) + d[j].slope(i));
      for (std::size_t l = 0; l < n; ++l)
        note(1, s.k(i, j).slope(l) + s.k(j, l).slope(i) + s.k(l, i).slope(j));
    }
  return worst;
}
/// K^ of (12).
template <class T>
Table<T> contact_structure_at(const BirkhoffSystem& s, const std::vector<T>& zt) {
  const Table<T> k = structure_at(s, zt);
  const std::vector<T> g = right_side_at(s, zt);
  Table<T> all = zero_table<T>(s.size() + 1, s.size() + 1);
  for (std::size_t i = 0; i < s.size(); ++i) {
    all[0][i + 1] = g[i];
    all[i + 1][0] = T(0) - g[i];
    for (std::size_t j = 0; j < s.size(); ++j) all[i + 1][j + 1] = k[i][j];
  }
  return all;
}
/// d(F~_i dz~_i) of (13) on two vectors (t, z), with F~ = (-B, F).
template <class T>
T exterior_derivative_at(const BirkhoffSystem& s, const std::vector<T>& zt, const std::vector<T>& u,
                         const std::vector<T>& v) {
  const std::size_t n = s.size();
  std::vector<Polynomial> form{Polynomial() - s.b};
  form.insert(form.end(), s.f.begin(), s.f.end());
  T sum(0);
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= n; ++j)  // d form_j / d z~_i dz~_i ^ dz~_j
      sum = sum + form[j].slope(i == 0 ? n : i - 1).at(zt) * (u[i] * v[j] - v[i] * u[j]);
  return sum;
}
/// The double sum K^_ij dz~_i ^ dz~_j of (9) and (11) on two vectors.
template <class T>
T double_sum(const Table<T>& k, const std::vector<T>& u, const std::vector<T>& v) {
  T sum(0);
  for (std::size_t i = 0; i < k.size(); ++i)
    for (std::size_t j = 0; j < k.size(); ++j) sum = sum + k[i][j] * (u[i] * v[j] - u[j] * v[i]);
  return sum;
}

/// F_i = weight int_0^1 lambda^power z_j K_ji(lambda z) dlambda: (17) is printed with weight 1/2 and power 0,
/// and is right with weight 1 and power 1.
inline std::vector<Polynomial> constructed_form(const BirkhoffSystem& s, const Rational& weight, int power) {
  std::vector<Polynomial> form(s.size());
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = 0; j < s.size(); ++j)
      form[i] = form[i] + Polynomial(weight) * Polynomial::variable(j) * s.k(j, i).along_ray(s.size(), power);
  return form;
}
/// D_i + dF_i/dt of (14) for a form F.
inline std::vector<Polynomial> forces(const BirkhoffSystem& s, const std::vector<Polynomial>& form) {
  std::vector<Polynomial> sum;
  for (std::size_t i = 0; i < s.size(); ++i) sum.push_back(s.d(i) + form[i].slope(s.size()));
  return sum;
}
/// int_0^1 z_i (D_i + dF_i/dt)(lambda z) dlambda of (18), which has a minus in front when corrected.
inline Polynomial constructed_function(const BirkhoffSystem& s, const std::vector<Polynomial>& form) {
  const std::vector<Polynomial> sum = forces(s, form);
  Polynomial b;
  for (std::size_t i = 0; i < s.size(); ++i) b = b + Polynomial::variable(i) * sum[i].along_ray(s.size(), 0);
  return b;
}

}  // namespace pfaff::printed
