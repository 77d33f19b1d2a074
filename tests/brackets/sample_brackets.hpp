// Brackets and constraints to test identities with: Poisson and not, skew, symmetric and neither.
#pragma once

#include <array>
#include <random>
#include <vector>

#include <pfaff/brackets/conformance/polynomial.hpp>
#include <pfaff/brackets/reduction/almost_dirac.hpp>
#include <pfaff/core/bracket.hpp>

namespace pfaff::testing {

/// P_ij(z) polynomials of any symmetry; a random skew one does not obey Jacobi's identity.
struct PolynomialBracket {
  Symmetry symmetry;
  std::vector<Polynomial> entries;  // n x n; below the diagonal only where there is no symmetry

  PolynomialBracket(Symmetry s, std::size_t n, std::mt19937& random) : symmetry(s) {
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

/// <f, g> = sum_k (b_k . df)(b_k . dg), b_k with polynomial entries: never negative.
struct SquaresBracket {
  std::vector<std::vector<Polynomial>> vectors;
  SquaresBracket(std::size_t n, std::size_t count, std::mt19937& random) : vectors(count) {
    for (auto& b : vectors)
      for (std::size_t i = 0; i < n; ++i) b.emplace_back(n, random, 2);
  }
  template <class T>
  void sharp(const T& /*t*/, In<T> z, In<T> covector, Out<T> vector) const {
    for (T& v : vector) v = T(0);
    for (const auto& b : vectors) {
      std::vector<T> at;
      T sum(0);
      for (std::size_t i = 0; i < z.size(); ++i) {
        at.push_back(b[i].operator()<T>(z));
        sum = sum + at[i] * covector[i];
      }
      for (std::size_t i = 0; i < z.size(); ++i) vector[i] = vector[i] + sum * at[i];
    }
  }
};

/// Polynomial constraints.
struct PolynomialConstraints {
  std::vector<Polynomial> functions;
  PolynomialConstraints(std::size_t count, std::size_t n, std::mt19937& random) {
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

/// The Dirac bracket (1.2), with W factored densely: eta(f, g) - eta(f, phi_i) C_ij eta(phi_j, g).
template <class B>
struct DenseDirac {
  B base;
  PolynomialConstraints constraints;
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const std::size_t n = z.size(), count = constraints.count();
    std::vector<T> rows(count * n), images(count * n), right(count), share(count);
    constraints.gradients<T>(t, z, rows);
    base.sharp(t, z, covector, vector);
    LU<T> lu(count);
    for (std::size_t b = 0; b < count; ++b) {
      const auto image = std::span<T>(images).subspan(b * n, n);
      base.sharp(t, z, In<T>(std::span<const T>(rows).subspan(b * n, n)), image);
      for (std::size_t a = 0; a < count; ++a) {
        T sum(0);
        for (std::size_t i = 0; i < n; ++i) sum = sum + rows[a * n + i] * image[i];
        lu(a, b) = sum;
      }
      right[b] = T(0);
      for (std::size_t i = 0; i < n; ++i) right[b] = right[b] + rows[b * n + i] * vector[i];
    }
    lu.factor();
    lu.solve(right.data(), share.data());
    for (std::size_t b = 0; b < count; ++b)
      for (std::size_t i = 0; i < n; ++i) vector[i] = vector[i] - images[b * n + i] * share[b];
  }
};

}  // namespace pfaff::testing
