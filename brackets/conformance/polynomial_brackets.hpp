// Brackets and constraints with random polynomial entries: Poisson and not, skew, symmetric and neither. What
// identities are tested on, and what must fail them.
#pragma once

#include <vector>

#include <pfaff/brackets/conformance/polynomial.hpp>
#include <pfaff/core/bracket.hpp>

namespace pfaff {

/// P_ij(z) polynomials of any symmetry; a random skew one does not obey Jacobi's identity.
struct PolynomialBracket {
  Symmetry symmetry;
  std::vector<Polynomial> entries;  // n x n; below the diagonal only where there is no symmetry

  template <class Random>
  PolynomialBracket(Symmetry s, std::size_t n, Random& random) : symmetry(s) {
    for (std::size_t k = 0; k < n * n; ++k) entries.emplace_back(n, random, 3);
  }
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const std::size_t n = z.size();
    for (T& v : vector) v = T(0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = symmetry == Symmetry::none ? 0 : i; j < n; ++j) {
        if (symmetry == Symmetry::skew && i == j) continue;
        const T p = entries[i * n + j].operator()<T>(z);
        vector[i] = vector[i] + p * covector[j];
        if (symmetry == Symmetry::skew) vector[j] = vector[j] - p * covector[i];
        if (symmetry == Symmetry::symmetric && i != j) vector[j] = vector[j] + p * covector[i];
      }
  }
};

/// {f, g} = grad c . (grad f x grad g) in three dimensions, the canonical bracket in the others, (q, p) pairs
/// after the first three: Poisson, of rank n - 1, with Casimir c.
struct NambuCanonicalBracket {
  Polynomial casimir;
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    const auto c = casimir.gradient<T>(z.first(3));
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      vector[i] = covector[j] * c[k] - covector[k] * c[j];
    }
    for (std::size_t i = 3; i + 1 < z.size(); i += 2) {
      vector[i] = covector[i + 1];
      vector[i + 1] = -covector[i];
    }
  }
};

/// Polynomial constraints, with gradients.
struct PolynomialConstraints {
  std::vector<Polynomial> functions;
  template <class Random>
  PolynomialConstraints(std::size_t count, std::size_t n, Random& random) {
    for (std::size_t k = 0; k < count; ++k) functions.emplace_back(n, random, 4);
  }
  [[nodiscard]] std::size_t count() const { return functions.size(); }
  template <class T>
  void gradients(const T& /*t*/, In<T> z, Out<T> rows) const {
    for (std::size_t k = 0; k < functions.size(); ++k) {
      const auto slope = functions[k].gradient<T>(z);
      for (std::size_t i = 0; i < z.size(); ++i) rows[k * z.size() + i] = slope[i];
    }
  }
};

}  // namespace pfaff
