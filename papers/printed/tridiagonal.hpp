// Nguyen & Turski, (4.6) and appendix C as printed: inverses of symmetric tridiagonal matrices. T is Quad or
// Rational; (C.12)-(C.17) take roots.
#pragma once

#include <pfaff/papers/printed/dense.hpp>

namespace pfaff::printed {

/// (C.1): c_1 .. c_K on the diagonal and b_1 .. b_{K-1} beside it; indices count from 0 here.
template <class T>
struct Tridiagonal {
  std::vector<T> c, b;
  [[nodiscard]] std::size_t size() const { return c.size(); }
};
template <class T>
Tridiagonal<T> tridiagonal(const Table<T>& m) {
  Tridiagonal<T> s;
  for (std::size_t k = 0; k < m.size(); ++k) {
    s.c.push_back(m[k][k]);
    if (k + 1 < m.size()) s.b.push_back(m[k][k + 1]);
  }
  return s;
}
template <class T>
Table<T> dense(const Tridiagonal<T>& s) {
  Table<T> m = zero_table<T>(s.size(), s.size());
  for (std::size_t k = 0; k < s.size(); ++k) {
    m[k][k] = s.c[k];
    if (k + 1 < s.size()) m[k][k + 1] = m[k + 1][k] = s.b[k];
  }
  return m;
}

/// (C.3): S_0, .., S_K.
template <class T>
std::vector<T> leading_determinants(const Tridiagonal<T>& s) {
  std::vector<T> list{T(1), s.c[0]};
  for (std::size_t k = 2; k <= s.size(); ++k)
    list.push_back(s.c[k - 1] * list[k - 1] - s.b[k - 2] * s.b[k - 2] * list[k - 2]);
  return list;
}

/// |S(first, .., last)| of (4.6), by its definition; 1 for the empty block.
template <class T>
T block(const Tridiagonal<T>& s, std::size_t first, std::size_t end) {
  std::vector<std::size_t> members;
  for (std::size_t k = first; k < end; ++k) members.push_back(k);
  return determinant(part(dense(s), members, members));
}
/// (-1)^{i+j} front |behind| / |S| b_i .. b_{j-1}, the form of (4.6), (C.4) and (C.6), where front(i) is the
/// determinant of the rows before i and behind(j) that of the rows after j.
template <class T, class Front, class Behind>
Table<T> inverse_of_minors(const Tridiagonal<T>& s, const Front& front, const Behind& behind,
                           const T& whole) {
  Table<T> m = zero_table<T>(s.size(), s.size());
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = i; j < s.size(); ++j) {
      T entry = front(i) * behind(j) / whole;
      for (std::size_t k = i; k < j; ++k) entry = T(0) - entry * s.b[k];
      m[i][j] = m[j][i] = entry;
    }
  return m;
}
/// (4.6), (C.4).
template <class T>
Table<T> inverse_by_minors(const Tridiagonal<T>& s) {
  return inverse_of_minors(
      s, [&](std::size_t i) { return block(s, 0, i); },
      [&](std::size_t j) { return block(s, j + 1, s.size()); }, block(s, 0, s.size()));
}
/// (C.6) with the numbers d of (C.5), whose d_0 is printed as 0.
template <class T>
Table<T> inverse_by_recursion(const Tridiagonal<T>& s, const T& d_0) {
  // d_0 .. d_i of (C.5) for the block that begins at row l.
  const auto d = [&](std::size_t l, std::size_t i) {
    std::vector<T> list{d_0};
    for (std::size_t k = 1; k <= i; ++k)
      list.push_back(k == 1 ? s.c[l]
                            : s.c[l + k - 1] * list[k - 1] - s.b[l + k - 2] * s.b[l + k - 2] * list[k - 2]);
    return list[i];
  };
  return inverse_of_minors(
      s, [&](std::size_t i) { return d(0, i); }, [&](std::size_t j) { return d(j + 1, s.size() - j - 1); },
      d(0, s.size()));
}

/// (C.2) of two vectors.
template <class T>
Table<T> one_pair(const std::vector<T>& u, const std::vector<T>& w) {
  Table<T> q = zero_table<T>(u.size(), u.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t j = i; j < u.size(); ++j) q[i][j] = q[j][i] = u[i] * w[j];
  return q;
}
/// (C.7) and (C.8).
template <class T>
struct OnePair {
  std::vector<T> u, w;
};
template <class T>
OnePair<T> pair_of_inverse(const Tridiagonal<T>& s) {
  OnePair<T> pair;
  const std::size_t n = s.size();
  for (std::size_t i = 0; i < n; ++i) {
    T couplings(1);
    for (std::size_t k = i; k + 1 < n; ++k) couplings = couplings * s.b[k];
    const T sign(i % 2 == 0 ? -1 : 1);  // (-1)^i, counted from 1
    pair.u.push_back(sign * block(s, 0, i) * couplings / block(s, 0, n));
    pair.w.push_back(sign * block(s, i + 1, n) / couplings);
  }
  return pair;
}

/// The numbers of (C.14) and (C.15), k = 1 .. K - 1, and x_K, which the paper does not define.
template <class T>
struct Factors {
  std::vector<T> a, beta, d, x, y, z;
};
template <class T>
Factors<T> factors(const Tridiagonal<T>& s) {
  Factors<T> f;
  for (std::size_t k = 0; k + 1 < s.size(); ++k) {
    f.a.push_back(k == 0 ? s.c[0] : T(1));
    f.beta.push_back(
        k == 0 ? s.b[0]
               : s.b[k] * sqrt(f.a[k - 1] / (f.a[k - 1] * f.d[k - 1] - f.beta[k - 1] * f.beta[k - 1])));
    f.d.push_back(s.c[k + 1]);
    const T rest = f.a[k] * f.d[k] - f.beta[k] * f.beta[k];
    f.x.push_back(1 / sqrt(f.a[k]));
    f.y.push_back(-(f.beta[k] / sqrt(f.a[k] * rest)));
    f.z.push_back(sqrt(f.a[k]) / sqrt(rest));
  }
  return f;
}
/// (C.10): U_k, k from 0.
template <class T>
Table<T> elementary(const Factors<T>& f, std::size_t k) {
  Table<T> u = unit_table<T>(f.x.size() + 1);
  u[k][k] = f.x[k];
  u[k][k + 1] = f.y[k];
  u[k + 1][k + 1] = f.z[k];
  return u;
}
/// U = U_1 .. U_{K-1}.
template <class T>
Table<T> upper_by_product(const Factors<T>& f) {
  Table<T> u = elementary(f, 0);
  for (std::size_t k = 1; k < f.x.size(); ++k) u = product(u, elementary(f, k));
  return u;
}
/// (C.12), with x_K = 1.
template <class T>
Table<T> upper_by_formula(Factors<T> f) {
  const std::size_t n = f.x.size() + 1;
  f.x.push_back(T(1));
  Table<T> u = zero_table<T>(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) {
      u[i][j] = f.x[j] * (i == 0 ? T(1) : f.z[i - 1]);
      for (std::size_t k = i; k < j; ++k) u[i][j] = u[i][j] * f.y[k];
    }
  return u;
}
/// (C.16) with the sum up to `last`: K - 1 as printed, K corrected (with x_K = 1).
template <class T>
Table<T> inverse_by_sums(Factors<T> f, std::size_t last) {
  const std::size_t n = f.x.size() + 1;
  f.x.push_back(T(1));
  const auto z = [&](std::size_t i) { return i == 0 ? T(1) : f.z[i - 1]; };
  Table<T> m = zero_table<T>(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) {
      for (std::size_t k = j; k < last; ++k) {
        T term = f.x[k] * f.x[k] * z(i) * z(j);
        for (std::size_t l = i; l < k; ++l) term = term * f.y[l];
        for (std::size_t l = j; l < k; ++l) term = term * f.y[l];
        m[i][j] = m[i][j] + term;
      }
      m[j][i] = m[i][j];
    }
  return m;
}
/// (C.17): beta_1 .. beta_{K-1}.
template <class T>
std::vector<T> couplings(const Tridiagonal<T>& s) {
  std::vector<T> beta{s.b[0]};
  for (std::size_t k = 1; k + 1 < s.size(); ++k)
    beta.push_back(k == 1 ? s.b[1] * sqrt(s.c[0] / (s.c[0] * s.c[1] - s.b[0] * s.b[0]))
                          : s.b[k] * sqrt(1 / (s.c[k] - beta[k - 1] * beta[k - 1])));
  return beta;
}

}  // namespace pfaff::printed
