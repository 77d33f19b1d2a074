// Lie-Poisson brackets: {f, g}(z) = z_k c_ij^k f_i g_j with the structure constants c of a Lie algebra, up to
// the sign of the left-invariant convention. The Casimirs of so(3)* are the functions of |z|^2.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// [e_i, e_j] = value e_k, and the same with i and j exchanged and the sign turned.
struct StructureConstant {
  int i, j, k;
  Real value;
};

/// The term value z_i z_j of a quadratic form.
struct QuadraticTerm {
  int i, j;
  Real value;
};

/// The bracket {z_i, z_j} = sign * c_ij^k z_k, with those of its Casimirs that are quadratic forms.
struct LiePoissonBracket {
  std::vector<StructureConstant> constants;
  Real sign = 1;
  std::vector<std::vector<QuadraticTerm>> quadratic_casimirs{};

  [[nodiscard]] int casimir_count() const { return static_cast<int>(quadratic_casimirs.size()); }
  template <class T>
  void casimirs(const T& /*t*/, In<T> z, Out<T> values) const {
    for (std::size_t c = 0; c < quadratic_casimirs.size(); ++c) {
      values[c] = T(0);
      for (const QuadraticTerm& q : quadratic_casimirs[c])
        values[c] =
            values[c] + T(q.value) * z[static_cast<std::size_t>(q.i)] * z[static_cast<std::size_t>(q.j)];
    }
  }

  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    for (T& v : vector) v = T(0);
    for (const StructureConstant& c : constants) {
      const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j),
                 k = static_cast<std::size_t>(c.k);
      const T element = T(sign * c.value) * z[k];
      vector[i] = vector[i] + element * covector[j];
      vector[j] = vector[j] - element * covector[i];
    }
  }

  /// The largest |sum of [[e_i, e_j], e_k] over cyclic i, j, k|: 0 for the structure constants of a Lie
  /// algebra, and then the bracket obeys Jacobi's identity.
  [[nodiscard]] double algebra_residual(int dimension) const {
    const auto n = static_cast<std::size_t>(dimension);
    std::vector<double> c(n * n * n);  // [e_i, e_j] = c_ijk e_k
    for (const StructureConstant& s : constants) {
      const auto i = static_cast<std::size_t>(s.i), j = static_cast<std::size_t>(s.j),
                 k = static_cast<std::size_t>(s.k);
      c[(i * n + j) * n + k] += s.value.value();
      c[(j * n + i) * n + k] -= s.value.value();
    }
    double worst = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t m = 0; m < n; ++m) {
            double total = 0;
            for (std::size_t l = 0; l < n; ++l)
              total += c[(i * n + j) * n + l] * c[(l * n + k) * n + m] +
                       c[(j * n + k) * n + l] * c[(l * n + i) * n + m] +
                       c[(k * n + i) * n + l] * c[(l * n + j) * n + m];
            worst = std::max(worst, std::abs(total));
          }
    return worst;
  }

  /// Rotations, [e_1, e_2] = e_3 and cyclic. Casimirs: functions of |z|^2.
  static LiePoissonBracket so3(Real sign = 1) {
    return {{{0, 1, 2, 1}, {1, 2, 0, 1}, {2, 0, 1, 1}}, sign, {{{0, 0, 1}, {1, 1, 1}, {2, 2, 1}}}};
  }
  /// Rotations and translations, z = (Pi, Gamma). Casimirs: |Gamma|^2 and Pi.Gamma.
  static LiePoissonBracket se3(Real sign = 1) {
    return {{{0, 1, 2, 1},
             {1, 2, 0, 1},
             {2, 0, 1, 1},
             {0, 4, 5, 1},
             {1, 5, 3, 1},
             {2, 3, 4, 1},
             {3, 1, 5, 1},
             {4, 2, 3, 1},
             {5, 0, 4, 1}},
            sign,
            {{{3, 3, 1}, {4, 4, 1}, {5, 5, 1}}, {{0, 3, 1}, {1, 4, 1}, {2, 5, 1}}}};
  }
  /// Traceless 2 x 2 matrices, z = (h, e, f): [h, e] = 2 e, [h, f] = -2 f, [e, f] = h. Casimir: h^2 + 4 e f.
  static LiePoissonBracket sl2(Real sign = 1) {
    return {{{0, 1, 1, 2}, {0, 2, 2, -2}, {1, 2, 0, 1}}, sign, {{{0, 0, 1}, {1, 2, 4}}}};
  }
  /// The body bracket of a rigid body on so(3)*: {f, g} = -z.(grad f x grad g), z the angular momentum.
  static LiePoissonBracket rigid_body() { return so3(-1); }
};

}  // namespace pfaff
