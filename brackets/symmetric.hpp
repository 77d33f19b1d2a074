// Symmetric brackets. Semimetric ones are non-negative, <f, f> >= 0: those of friction,
//   <f, g> = sum_i lambda_i(z) f_{p_i} g_{p_i},   lambda_i >= 0   (nguyen-turski section 4),
// and in general C C^T of any matrix C. Pseudo-metric ones have any signature: G = diag(+1 .. -1 .. 0) in
// suitable coordinates (a constant G is brackets/constant_poisson.hpp with a symmetric tensor).
#pragma once

#include <utility>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// <p_i, p_j> = delta_ij lambda_i on (q, p); F writes the n coefficients: fill(t, z, lambda).
template <class F>
struct FrictionBracket {
  F fill;

  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const std::size_t half = z.size() / 2;
    std::vector<T> lambda(half, T(0));
    fill(t, z, Out<T>(lambda));
    for (std::size_t k = 0; k < half; ++k) {
      vector[k] = T(0);
      vector[half + k] = lambda[k] * covector[half + k];
    }
  }
};
template <class F>
FrictionBracket<F> friction_bracket(F fill) {
  return {std::move(fill)};
}

/// G = C C^T, semimetric by construction; F writes C, n x `columns` row-major, zero before.
template <class F>
struct SquareBracket {
  std::size_t columns;
  F fill;

  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const std::size_t n = z.size();
    std::vector<T> c(n * columns, T(0));
    fill(t, z, Out<T>(c));
    for (T& x : vector) x = T(0);
    for (std::size_t k = 0; k < columns; ++k) {
      T along(0);
      for (std::size_t i = 0; i < n; ++i) along = along + c[i * columns + k] * covector[i];
      for (std::size_t i = 0; i < n; ++i) vector[i] = vector[i] + c[i * columns + k] * along;
    }
  }
};
template <class F>
SquareBracket<F> square_bracket(std::size_t columns, F fill) {
  return {columns, std::move(fill)};
}

}  // namespace pfaff
