// What a bracket must fulfil, measured: residuals at points, for any struct with
//   template <class T> void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const.
//
// {f, g} = df . sharp(dg). Derivatives of the bracket, which Jacobi's identity needs, are exact: sharp is
// evaluated with dual numbers. Scalars: double, Quad, Rational; exact scalars give exact zeros. Each residual
// comes with the sum of absolute values of its terms, by which it is judged.
#pragma once

#include <cstddef>
#include <random>
#include <utility>
#include <vector>

#include <pfaff/brackets/conformance/polynomial.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// A sum that should vanish, and the sum of the absolute values of its terms.
template <class T>
struct IdentityResidual {
  T residual{}, size{};

  void add(const T& term) {
    residual = residual + term;
    size = size + abs(term);
  }
  /// |residual| / size; 0 where both vanish, infinite where a term is not finite.
  [[nodiscard]] double relative() const {
    if (!isfinite(size)) return std::numeric_limits<double>::infinity();
    return size > T(0) ? static_cast<double>(T(abs(residual) / size)) : 0;
  }
};

/// A sharp map with one scalar at one point and time.
template <class T, class B>
std::vector<T> sharp_at(const B& bracket, const T& t, In<T> z, In<T> covector) {
  std::vector<T> vector(z.size());
  bracket.sharp(t, z, covector, Out<T>(vector));
  return vector;
}

/// The matrix P_ij = {z_i, z_j}.
template <class T, class B>
Matrix<T> bracket_matrix(const B& bracket, const T& t, In<T> z) {
  const std::size_t n = z.size();
  Matrix<T> p(n, n);
  std::vector<T> unit(n);
  for (std::size_t j = 0; j < n; ++j) {
    unit[j] = T(1);
    const auto column = sharp_at<T>(bracket, t, z, unit);
    unit[j] = T(0);
    for (std::size_t i = 0; i < n; ++i) p(i, j) = column[i];
  }
  return p;
}

/// df . P dg.
template <class T>
T paired(const std::vector<T>& f, const Matrix<T>& p, const std::vector<T>& g) {
  T sum(0);
  for (std::size_t i = 0; i < f.size(); ++i)
    for (std::size_t j = 0; j < g.size(); ++j) sum = sum + f[i] * p(i, j) * g[j];
  return sum;
}

/// {f, g} + {g, f}.
template <class T, class B>
IdentityResidual<T> antisymmetry_residual(const B& bracket, const T& t, In<T> z, const Polynomial& f,
                                          const Polynomial& g) {
  const auto p = bracket_matrix<T>(bracket, t, z);
  const auto df = f.template gradient<T>(z), dg = g.template gradient<T>(z);
  IdentityResidual<T> r;
  for (std::size_t i = 0; i < z.size(); ++i)
    for (std::size_t j = 0; j < z.size(); ++j) {
      r.add(df[i] * p(i, j) * dg[j]);
      r.add(dg[j] * p(j, i) * df[i]);
    }
  return r;
}
/// {f, g} - {g, f}.
template <class T, class B>
IdentityResidual<T> symmetry_residual(const B& bracket, const T& t, In<T> z, const Polynomial& f,
                                      const Polynomial& g) {
  const auto p = bracket_matrix<T>(bracket, t, z);
  const auto df = f.template gradient<T>(z), dg = g.template gradient<T>(z);
  IdentityResidual<T> r;
  for (std::size_t i = 0; i < z.size(); ++i)
    for (std::size_t j = 0; j < z.size(); ++j) {
      r.add(df[i] * p(i, j) * dg[j]);
      r.add(-(dg[j] * p(j, i) * df[i]));
    }
  return r;
}
/// {f, g h} - h {f, g} - g {f, h}, where sharp is asked three times: a map that is not linear in the covector
/// fails.
template <class T, class B>
IdentityResidual<T> leibniz_residual(const B& bracket, const T& t, In<T> z, const Polynomial& f,
                                     const Polynomial& g, const Polynomial& h) {
  const auto df = f.template gradient<T>(z), dg = g.template gradient<T>(z), dh = h.template gradient<T>(z);
  // d(g h) = g dh + h dg.
  const T at_g = g.template operator()<T>(z), at_h = h.template operator()<T>(z);
  std::vector<T> d_product(z.size());
  for (std::size_t i = 0; i < z.size(); ++i) d_product[i] = at_g * dh[i] + at_h * dg[i];
  const auto whole = sharp_at<T>(bracket, t, z, d_product), one = sharp_at<T>(bracket, t, z, dg),
             other = sharp_at<T>(bracket, t, z, dh);
  IdentityResidual<T> r;
  for (std::size_t i = 0; i < z.size(); ++i) {
    r.add(df[i] * whole[i]);
    r.add(-(df[i] * at_h * one[i]));
    r.add(-(df[i] * at_g * other[i]));
  }
  return r;
}

/// d_k P_ij at [k], by duals.
template <class T, class B>
std::vector<Matrix<T>> bracket_slopes(const B& bracket, const T& t, In<T> z) {
  using D = Dual<T, 1>;
  const std::size_t n = z.size();
  std::vector<Matrix<T>> slopes;
  std::vector<D> x(z.begin(), z.end());
  for (std::size_t k = 0; k < n; ++k) {
    x[k].derivative[0] = T(1);
    const auto p = bracket_matrix<D>(bracket, D(t), x);
    x[k].derivative[0] = T(0);
    Matrix<T> slope(n, n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) slope(i, j) = p(i, j).derivative[0];
    slopes.push_back(std::move(slope));
  }
  return slopes;
}

/// {f, {g, h}} + {g, {h, f}} + {h, {f, g}} of the coordinates z_i, z_j, z_k, the largest residual and the
/// largest size over all triples: P_il d_l P_jk + cyclic. Second derivatives of f, g, h drop out where P is
/// skew.
template <class T>
IdentityResidual<T> jacobi_residual(const Matrix<T>& p, const std::vector<Matrix<T>>& slopes) {
  const std::size_t n = p.rows();
  IdentityResidual<T> worst;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        IdentityResidual<T> r;
        for (std::size_t l = 0; l < n; ++l) {
          r.add(p(i, l) * slopes[l](j, k));
          r.add(p(j, l) * slopes[l](k, i));
          r.add(p(k, l) * slopes[l](i, j));
        }
        if (!(abs(r.residual) <= worst.residual)) worst.residual = abs(r.residual);
        if (!(r.size <= worst.size)) worst.size = r.size;
      }
  return worst;
}
template <class T, class B>
IdentityResidual<T> jacobi_residual(const B& bracket, const T& t, In<T> z) {
  return jacobi_residual(bracket_matrix<T>(bracket, t, z), bracket_slopes<T>(bracket, t, z));
}

/// {c, z_i} for every i: the largest, and the largest sum of terms; c by its gradient.
template <class T, class B>
IdentityResidual<T> casimir_residual(const B& bracket, const T& t, In<T> z, const std::vector<T>& gradient) {
  const auto p = bracket_matrix<T>(bracket, t, z);
  IdentityResidual<T> worst;
  for (std::size_t i = 0; i < z.size(); ++i)
    for (const bool left : {true, false}) {
      IdentityResidual<T> r;
      for (std::size_t j = 0; j < z.size(); ++j) r.add((left ? p(j, i) : p(i, j)) * gradient[j]);
      if (!(abs(r.residual) <= worst.residual)) worst.residual = abs(r.residual);
      if (!(r.size <= worst.size)) worst.size = r.size;
    }
  return worst;
}

/// The least <f, f> over the covectors given, relative to the sum of the absolute values of its terms: not
/// below round-off where the bracket is semimetric.
template <class T, class B>
double least_square(const B& bracket, const T& t, In<T> z, const std::vector<std::vector<T>>& covectors) {
  const auto p = bracket_matrix<T>(bracket, t, z);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& f : covectors) {
    IdentityResidual<T> r;
    for (std::size_t i = 0; i < z.size(); ++i)
      for (std::size_t j = 0; j < z.size(); ++j) r.add(f[i] * p(i, j) * f[j]);
    const double relative = r.relative();
    const double signed_square = r.residual < T(0) ? -relative : relative;
    if (!(signed_square >= least)) least = signed_square;
  }
  return least;
}

/// Points about `centre`, within `spread` in each coordinate, as fractions with denominator 1024.
template <class T, class Random>
std::vector<std::vector<T>> sample_points(const std::vector<T>& centre, Random& random, int count,
                                          const T& spread = T(1)) {
  std::uniform_int_distribution<int> draw(-1024, 1024);
  std::vector<std::vector<T>> points;
  for (int k = 0; k < count; ++k) {
    std::vector<T> z = centre;
    for (T& x : z) x = x + spread * T(draw(random)) / T(1024);
    points.push_back(std::move(z));
  }
  return points;
}

}  // namespace pfaff
