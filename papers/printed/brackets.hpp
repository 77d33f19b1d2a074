// Nguyen & Turski, sections 1 to 3 as printed: Dirac brackets of a matrix of brackets, their determinants and
// recursions. Brackets of all elements, the constraints first and then f, g, .., stand in one table G.
#pragma once

#include <initializer_list>

#include <pfaff/papers/printed/dense.hpp>

namespace pfaff::printed {

inline std::vector<std::size_t> counted(std::size_t first, std::size_t end,
                                        std::initializer_list<std::size_t> more = {}) {
  std::vector<std::size_t> list;
  for (std::size_t k = first; k < end; ++k) list.push_back(k);
  list.insert(list.end(), more.begin(), more.end());
  return list;
}

/// (1.1): df and dg as (q, p).
template <class T>
T canonical_bracket(const std::vector<T>& df, const std::vector<T>& dg) {
  const std::size_t n = df.size() / 2;
  T sum(0);
  for (std::size_t k = 0; k < n; ++k) sum = sum + df[k] * dg[n + k] - df[n + k] * dg[k];
  return sum;
}

/// (1.2), (3.5), (3.9): the brackets of the elements after the first `count`, which are the constraints.
template <class T>
Table<T> dirac_brackets(const Table<T>& g, std::size_t count) {
  const auto constraints = counted(0, count), rest = counted(count, g.size());
  return difference(part(g, rest, rest),
                    product(part(g, rest, constraints),
                            product(inverse(part(g, constraints, constraints)), part(g, constraints, rest))));
}
/// (1.2) as a tensor on covectors: P - P A^T (A P A^T)^-1 A P, A the gradients of the constraints in rows.
template <class T>
Table<T> dirac_tensor(const Table<T>& p, const Table<T>& a) {
  const Table<T> columns = product(p, transposed(a)), rows = product(a, p);
  return difference(p, product(columns, product(inverse(product(a, columns)), rows)));
}

/// F[rows, columns] of (3.1).
template <class T>
T bordered(const Table<T>& f, const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns) {
  return determinant(part(f, rows, columns));
}
/// (3.6), (3.7).
template <class T>
Table<T> determinant_formula(const Table<T>& g, std::size_t count) {
  const T whole = bordered(g, counted(0, count), counted(0, count));
  Table<T> quotients = zero_table<T>(g.size() - count, g.size() - count);
  for (std::size_t i = 0; i < quotients.size(); ++i)
    for (std::size_t j = 0; j < quotients.size(); ++j)
      quotients[i][j] = bordered(g, counted(0, count, {count + i}), counted(0, count, {count + j})) / whole;
  return quotients;
}

/// (3.8): the next bracket of all elements, by constraint k (from 0).
template <class T>
Table<T> symmetric_step(const Table<T>& g, std::size_t k) {
  Table<T> next = g;
  for (std::size_t f = 0; f < g.size(); ++f)
    for (std::size_t h = 0; h < g.size(); ++h) next[f][h] = g[f][h] - g[f][k] * g[k][h] / g[k][k];
  return next;
}
/// (3.15): the next bracket, by the constraints 2k + 1 and 2k + 2 (k from 0).
template <class T>
Table<T> skew_step(const Table<T>& g, std::size_t k) {
  const std::size_t a = 2 * k, b = 2 * k + 1;
  Table<T> next = g;
  for (std::size_t f = 0; f < g.size(); ++f)
    for (std::size_t h = 0; h < g.size(); ++h)
      next[f][h] = g[f][h] - (g[f][b] * g[a][h] - g[f][a] * g[b][h]) / g[a][b];
  return next;
}

/// (2.1) for two covectors: K(p* alpha, p* beta) with p onto F along V, bases in the columns of `f` and `v`.
template <class T>
Table<T> reduced_tensor(const Table<T>& k, const Table<T>& f, const Table<T>& v) {
  Table<T> basis = f;
  for (std::size_t i = 0; i < f.size(); ++i) basis[i].insert(basis[i].end(), v[i].begin(), v[i].end());
  Table<T> onto = unit_table<T>(f.size());
  for (std::size_t i = f.front().size(); i < f.size(); ++i) onto[i][i] = T(0);
  const Table<T> p = product(basis, product(onto, inverse(basis)));
  return product(p, product(k, transposed(p)));
}

}  // namespace pfaff::printed
