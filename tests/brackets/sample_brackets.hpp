// Brackets to test identities with.
#pragma once

#include <array>
#include <random>
#include <vector>

#include <pfaff/brackets/conformance/polynomial_brackets.hpp>
#include <pfaff/brackets/reduction/almost_dirac.hpp>
#include <pfaff/core/bracket.hpp>

namespace pfaff::testing {

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

/// The Dirac bracket (1.2), with W factored densely: eta(f, g) - eta(f, phi_i) C_ij eta(phi_j, g).
template <class B>
struct DenseDiracTensor {
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
