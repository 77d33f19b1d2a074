// The almost Dirac reduction of a bracket to the level sets of constraints (nguyen-turski (2.2)), for any
// smooth choice of a complement: K_N(alpha, beta) = K(p* alpha, p* beta), p = I - V (A V)^-1 A.
//
// A bracket again: bilinear, with the symmetry and the sign of the one reduced. Jacobi's identity is
// inherited where the complement V is P(TN^0), which gives the Dirac bracket, and not in general.
#pragma once

#include <cstddef>
#include <vector>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// C has count() and gradients(t, z, rows): K x n. V has columns(t, z, covectors as rows of C, vectors): K
/// vectors of n, one after the other, which together with the tangent space of the level sets make up the
/// whole space. Where they do not, the result is not finite. It allocates and is meant for checks at points.
template <class B, class C, class V>
struct AlmostDiracReduction {
  B base;
  C constraints;
  V complement;

  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const std::size_t n = z.size(), count = constraints.count();
    std::vector<T> rows(count * n), columns(count * n), right(count), share(count);
    constraints.template gradients<T>(t, z, rows);
    complement.template columns<T>(t, z, rows, columns);
    LU<T> lu(count), transposed(count);
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b) {
        T sum(0);
        for (std::size_t i = 0; i < n; ++i) sum = sum + rows[a * n + i] * columns[b * n + i];
        lu(a, b) = sum;
        transposed(b, a) = sum;
      }
    if (!lu.factor() || !transposed.factor()) {
      for (T& v : vector) v = T(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    // p* alpha = alpha - A^T (A V)^-T V^T alpha, p v = v - V (A V)^-1 A v.
    const auto project = [&](std::vector<T>& x, const LU<T>& solver, const std::vector<T>& by,
                             const std::vector<T>& along) {
      for (std::size_t a = 0; a < count; ++a) {
        right[a] = T(0);
        for (std::size_t i = 0; i < n; ++i) right[a] = right[a] + by[a * n + i] * x[i];
      }
      solver.solve(right.data(), share.data());
      for (std::size_t a = 0; a < count; ++a)
        for (std::size_t i = 0; i < n; ++i) x[i] = x[i] - share[a] * along[a * n + i];
    };
    std::vector<T> alpha(covector.begin(), covector.end()), image(n);
    project(alpha, transposed, columns, rows);
    base.sharp(t, z, In<T>(alpha), Out<T>(image));
    project(image, lu, rows, columns);
    for (std::size_t i = 0; i < n; ++i) vector[i] = image[i];
  }
};

/// V = P(TN^0) of a bracket: the complement of Dirac's reduction.
template <class B>
struct DiracComplement {
  B base;
  template <class T>
  void columns(const T& t, In<T> z, In<T> rows, Out<T> vectors) const {
    const std::size_t n = z.size();
    for (std::size_t a = 0; a * n < rows.size(); ++a)
      base.sharp(t, z, rows.subspan(a * n, n), vectors.subspan(a * n, n));
  }
};

/// V = the gradients themselves: the complement orthogonal in the coordinates as they are.
struct NormalComplement {
  template <class T>
  void columns(const T& /*t*/, In<T> /*z*/, In<T> rows, Out<T> vectors) const {
    for (std::size_t k = 0; k < rows.size(); ++k) vectors[k] = rows[k];
  }
};

}  // namespace pfaff
