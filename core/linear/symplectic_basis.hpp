// Symplectic Gram-Schmidt with fixed pivots: a basis E in which a skew form K is canonical,
//
//   E^T K E = K_c = [[0, -I], [I, 0]].
//
// The pivots are pairs of coordinates, chosen once from numbers. With the pairs fixed, E is a rational
// function of the entries of K, made with + - * / alone: the same code serves doubles, duals and the
// recording scalar, and E(t) of a form K(t) is as smooth as K wherever no pivot vanishes. Pivots chosen anew
// at every t would make E jump.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// Pairs of coordinates that are made conjugate, in the order in which they are eliminated.
using PivotPairs = std::vector<std::pair<std::size_t, std::size_t>>;

namespace detail {
/// Makes the vectors that are left orthogonal to a and b: w <- w - x a - y b with x = <w, b> / <a, b> and y =
/// <a, w> / <a, b>, in the table form[i n + j] = <i, j> of their products. Calls visit(w, x, y) for each.
template <class T, class Visit>
void eliminate_pair(std::vector<T>& form, std::vector<char>& left, std::size_t a, std::size_t b,
                    Visit&& visit) {
  const std::size_t n = left.size();
  left[a] = left[b] = 0;
  const T pivot = form[a * n + b];
  std::vector<T> along_a(n), along_b(n);
  for (std::size_t w = 0; w < n; ++w)
    if (left[w] != 0) {
      along_a[w] = form[w * n + b] / pivot;
      along_b[w] = form[a * n + w] / pivot;
      visit(w, along_a[w], along_b[w]);
    }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (left[i] != 0 && left[j] != 0) {
        form[i * n + j] = form[i * n + j] - along_a[i] * form[a * n + j] - along_b[i] * form[b * n + j];
        form[j * n + i] = -form[i * n + j];
      }
}
}  // namespace detail

/// Pairs for the skew n x n matrix `form` (row-major): each time the two coordinates whose remaining
/// product is largest. Empty when the form is degenerate to working precision, that is, when no remaining
/// entry exceeds the rounding of what was subtracted from it. Every entry is judged by its own
/// subtractions, so that entries may have different units.
inline PivotPairs choose_pivot_pairs(std::span<const double> form, std::size_t n) {
  std::vector<double> products(form.begin(), form.end()), subtracted(n * n);
  for (std::size_t k = 0; k < n * n; ++k) subtracted[k] = std::abs(form[k]);
  std::vector<char> left(n, 1);
  PivotPairs pairs;
  if (n % 2 != 0) return {};
  const double rounding = 16 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  while (2 * pairs.size() < n) {
    std::size_t a = 0, b = 0;
    double best = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        const double size = std::abs(products[i * n + j]);
        if (left[i] == 0 || left[j] == 0 || !std::isfinite(size)) continue;
        if (size > rounding * subtracted[i * n + j] && size > best) {
          best = size;
          a = i;
          b = j;
        }
      }
    if (!(best > 0)) return {};
    const std::vector<double> before = products;
    std::vector<double> along_a(n), along_b(n);
    detail::eliminate_pair(products, left, a, b, [&](std::size_t w, double of_a, double of_b) {
      along_a[w] = of_a;
      along_b[w] = of_b;
    });
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        subtracted[i * n + j] +=
            std::abs(along_a[i] * before[a * n + j]) + std::abs(along_b[i] * before[b * n + j]);
    pairs.emplace_back(a, b);
  }
  return pairs;
}

/// The matrix E (row-major, its columns are the basis) with E^T K E = K_c for the skew matrix K = `form` of
/// size n = 2 pairs.size(), eliminating `pairs` in their order. Column k belongs to the first coordinate of
/// pair k. Column n/2 + k belongs to the second and is divided by minus the product of the two. A vanishing
/// pivot gives non-finite entries.
template <class T>
std::vector<T> symplectic_basis(std::span<const T> form, const PivotPairs& pairs) {
  const std::size_t half = pairs.size(), n = 2 * half;
  std::vector<T> products(form.begin(), form.end()), vectors(n * n, T(0)), basis(n * n, T(0));
  std::vector<char> left(n, 1);
  for (std::size_t k = 0; k < n; ++k) vectors[k * n + k] = T(1);  // column w is the vector w
  for (std::size_t k = 0; k < half; ++k) {
    const auto [a, b] = pairs[k];
    const T pivot = products[a * n + b];
    for (std::size_t i = 0; i < n; ++i) {
      basis[i * n + k] = vectors[i * n + a];
      basis[i * n + half + k] = -(vectors[i * n + b] / pivot);
    }
    detail::eliminate_pair(
        products, left, a, b, [&, a = a, b = b](std::size_t w, const T& along_a, const T& along_b) {
          for (std::size_t i = 0; i < n; ++i)
            vectors[i * n + w] =
                vectors[i * n + w] - along_a * vectors[i * n + a] - along_b * vectors[i * n + b];
        });
  }
  return basis;
}

/// y = E^-1 z without solving for it: E^-1 = K_c^-1 E^T K.
template <class T>
std::vector<T> symplectic_coordinates(std::span<const T> form, std::span<const T> basis,
                                      std::span<const T> z) {
  const std::size_t n = z.size(), half = n / 2;
  std::vector<T> covector(n, T(0)), y(n, T(0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) covector[i] = covector[i] + form[i * n + j] * z[j];
  const auto product = [&](std::size_t column) {
    T sum(0);
    for (std::size_t i = 0; i < n; ++i) sum = sum + basis[i * n + column] * covector[i];
    return sum;
  };
  for (std::size_t k = 0; k < half; ++k) {
    y[k] = product(half + k);
    y[half + k] = -product(k);
  }
  return y;
}

}  // namespace pfaff
