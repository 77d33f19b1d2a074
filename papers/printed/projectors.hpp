// Pitanga & Rodrigues, sections 2 and 3.1, as printed: projectors of a splitting and of a metric,
// coefficients of the metric in adapted frames, projectors of a symplectic foliation. Coordinates are (z^a,
// z^alpha), in this order, `free` of the first kind; Gamma^alpha_a stands in row alpha, a form in a row, a
// vector in a column.
#pragma once

#include <pfaff/papers/printed/dense.hpp>

namespace pfaff::printed {

/// The part of g_IJ or g^IJ with these kinds of indices: 0 for a, b, and 1 for alpha, beta.
template <class T>
Table<T> kinds(const Table<T>& g, std::size_t free, int row, int column) {
  const auto chosen = [&](int kind) {
    std::vector<std::size_t> list;
    for (std::size_t k = kind == 0 ? 0 : free; k < (kind == 0 ? free : g.size()); ++k) list.push_back(k);
    return list;
  };
  return part(g, chosen(row), chosen(column));
}

/// (5): P(Z) = Z^a (d_a - Gamma^alpha_a d_alpha), Q(Z) = (Z^alpha + Gamma^alpha_a Z^a) d_alpha.
template <class T>
std::vector<T> splitting_p(const Table<T>& gamma, const std::vector<T>& z) {
  const std::size_t free = gamma.front().size();
  std::vector<T> image(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(free));
  for (const T& x : product(gamma, image)) image.push_back(T(0) - x);
  return image;
}
template <class T>
std::vector<T> splitting_q(const Table<T>& gamma, const std::vector<T>& z) {
  const std::size_t free = gamma.front().size();
  std::vector<T> image(free, T(0));
  for (std::size_t alpha = 0; alpha < gamma.size(); ++alpha) {
    T sum = z[free + alpha];
    for (std::size_t a = 0; a < free; ++a) sum = sum + gamma[alpha][a] * z[a];
    image.push_back(sum);
  }
  return image;
}
/// (6).
template <class T>
Table<T> matrix_q(const Table<T>& gamma) {
  const std::size_t free = gamma.front().size();
  Table<T> q = zero_table<T>(free + gamma.size(), free + gamma.size());
  for (std::size_t alpha = 0; alpha < gamma.size(); ++alpha) {
    for (std::size_t a = 0; a < free; ++a) q[free + alpha][a] = gamma[alpha][a];
    q[free + alpha][free + alpha] = T(1);
  }
  return q;
}
template <class T>
Table<T> matrix_p(const Table<T>& gamma) {
  const Table<T> q = matrix_q(gamma);
  return difference(unit_table<T>(q.size()), q);
}
/// w^alpha = dz^alpha + Gamma^alpha_a dz^a in rows.
template <class T>
Table<T> forms(const Table<T>& gamma) {
  const std::size_t free = gamma.front().size();
  Table<T> a = gamma;
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i].resize(free + gamma.size(), T(0));
    a[i][free + i] = T(1);
  }
  return a;
}

/// (7): the coefficients of dz^a (x) dz^b, of dz^a (x) w^alpha and of w^alpha (x) w^beta.
template <class T>
struct Coefficients {
  Table<T> free, mixed, constrained;
};
template <class T>
Coefficients<T> metric_coefficients(const Table<T>& g, const Table<T>& gamma) {
  const std::size_t free = gamma.front().size();
  const Table<T> both = kinds(g, free, 0, 1), last = kinds(g, free, 1, 1);
  return {sum(product(both, gamma),
              sum(product(transposed(gamma), product(last, gamma)), kinds(g, free, 0, 0)), T(-2)),
          sum(difference(both, product(transposed(gamma), last)), zero_table<T>(free, gamma.size()), T(2)),
          last};
}
/// After (7): those of X_a (x) X_b, X_a (x) Y_alpha, Y_alpha (x) Y_beta, from g^IJ.
template <class T>
Coefficients<T> inverse_coefficients(const Table<T>& g, const Table<T>& gamma) {
  const std::size_t free = gamma.front().size();
  const Table<T> both = kinds(g, free, 0, 1), first = kinds(g, free, 0, 0), turned = transposed(gamma);
  const Table<T> mixed = sum(product(first, turned), both);
  return {first, sum(mixed, zero_table<T>(free, gamma.size()), T(2)),
          sum(product(transposed(both), turned),
              sum(product(gamma, product(first, turned)), kinds(g, free, 1, 1)), T(2))};
}

/// (8) and (9): xi^alpha G_{alpha beta} w^beta with xi^alpha = g^-1 w^alpha, for a given G_{alpha beta}.
template <class T>
Table<T> metric_q(const Table<T>& inverse_metric, const Table<T>& w, const Table<T>& g) {
  return product(product(inverse_metric, transposed(w)), product(g, w));
}
/// Before (8): G^{alpha beta} = w^beta(xi^alpha).
template <class T>
Table<T> upper_g(const Table<T>& inverse_metric, const Table<T>& w) {
  return product(w, product(inverse_metric, transposed(w)));
}
/// g(phi, psi) on covectors.
template <class T>
T on_covectors(const Table<T>& inverse_metric, const std::vector<T>& phi, const std::vector<T>& psi) {
  T sum(0);
  const std::vector<T> image = product(inverse_metric, psi);
  for (std::size_t i = 0; i < phi.size(); ++i) sum = sum + phi[i] * image[i];
  return sum;
}

/// Section 3.1, leaf coordinates z^a first and A^a_u in row a: X_u = d_u - sum_{a = 1..last} A^a_u Y_a, in
/// rows.
template <class T>
Table<T> transversal_fields(const Table<T>& a, std::size_t last) {
  const std::size_t m = a.size(), k = a.front().size();
  Table<T> fields = zero_table<T>(k, m + k);
  for (std::size_t u = 0; u < k; ++u) {
    fields[u][m + u] = T(1);
    for (std::size_t i = 0; i < last; ++i) fields[u][i] = T(0) - a[i][u];
  }
  return fields;
}
/// (11): lambda_ab w^b (x) Y_a, and (12): lambda_ab pi^bc w^a (x) Y_c, as maps of vectors. w in rows.
template <class T>
Table<T> leaf_map_11(const Table<T>& lambda, const Table<T>& w) {
  Table<T> map = product(lambda, w);
  map.resize(w.front().size(), std::vector<T>(w.front().size(), T(0)));
  return map;
}
template <class T>
Table<T> leaf_map_12(const Table<T>& lambda, const Table<T>& pi, const Table<T>& w) {
  Table<T> map = product(transposed(product(lambda, pi)), w);
  map.resize(w.front().size(), std::vector<T>(w.front().size(), T(0)));
  return map;
}

/// (26) with A* = A g^-1: Q = (A*)^t G^-1 A, G = A (A*)^t.
template <class T>
Table<T> constraint_q(const Table<T>& a, const Table<T>& inverse_metric) {
  const Table<T> star = transposed(product(a, inverse_metric));
  return product(star, product(inverse(product(a, star)), a));
}

/// After (41): D_ij = (P^k_j d_k P^l_i - P^k_i d_k P^l_j) p_l with P^l_i in row l, and d_k P at [k].
template <class T>
Table<T> momentum_brackets(const Table<T>& p, const std::vector<Table<T>>& slopes,
                           const std::vector<T>& momenta) {
  const std::size_t n = p.size();
  Table<T> d = zero_table<T>(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 0; l < n; ++l)
          d[i][j] = d[i][j] + (p[k][j] * slopes[k][l][i] - p[k][i] * slopes[k][l][j]) * momenta[l];
  return d;
}
/// (41) with the block that stands below P given.
template <class T>
Table<T> phase_space_tensor(const Table<T>& p, const Table<T>& below, const Table<T>& d) {
  const std::size_t n = p.size();
  Table<T> tensor = zero_table<T>(2 * n, 2 * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      tensor[i][n + j] = p[i][j];
      tensor[n + i][j] = below[i][j];
      tensor[n + i][n + j] = d[i][j];
    }
  return tensor;
}

}  // namespace pfaff::printed
