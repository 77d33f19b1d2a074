#include <pfaff/runs/support/congruence.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

namespace {
template <class T>
std::size_t size_of(const std::vector<T>& matrix) {
  return static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(matrix.size()))));
}

template <class T>
std::vector<T> absolute(std::vector<T> a) {
  for (T& x : a) x = abs(x);
  return a;
}

template <class T>
std::vector<T> transpose_of(const std::vector<T>& a, std::size_t n) {
  std::vector<T> b(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) b[j * n + i] = a[i * n + j];
  return b;
}
}  // namespace

template <class T>
CongruenceDifference<T>::CongruenceDifference(const Congruence<T>& of)
    : entries(of.m.size()), sizes(of.m.size()) {
  const std::size_t n = size_of(of.m);
  const std::vector<T> image = product(of.k1, of.m, n);  // image_size sums the absolute values of its terms
  const std::vector<T> image_size = product(absolute(of.k1), absolute(of.m), n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      T sum(0), size(0);
      for (std::size_t a = 0; a < n; ++a) {
        sum = sum + of.m[a * n + i] * image[a * n + j];
        size = size + abs(of.m[a * n + i]) * image_size[a * n + j];
      }
      entries[i * n + j] = sum - of.k0[i * n + j];
      sizes[i * n + j] = size;
    }
}

template <class T>
T congruence_residual(const CongruenceDifference<T>& difference) {
  T worst(0), scale(0);
  for (const T& x : difference.entries) {
    if (isnan(x)) return abs(x);
    worst = std::max(worst, T(abs(x)));
  }
  for (const T& x : difference.sizes) scale = std::max(scale, x);
  return worst / scale;
}

// A symmetric matrix is divided by roots of the largest numbers of its rows until these are alike.
template <class T>
std::vector<T> equilibrating_units(const Congruence<T>& of) {
  constexpr int passes = 20;
  constexpr double ordinary = 64;
  constexpr double none = -std::numeric_limits<double>::infinity();
  const std::size_t n = size_of(of.m);
  std::vector<T> moved = absolute(of.m);
  for (std::size_t i = 0; i < n; ++i) moved[i * n + i] = moved[i * n + i] + T(1);
  const std::vector<T> sizes = product(transpose_of(moved, n), product(absolute(of.k1), moved, n), n);
  std::vector<double> logarithms(n * n), exponent(n), change(n);
  for (std::size_t k = 0; k < n * n; ++k) {
    const auto size = static_cast<double>(sizes[k]);
    logarithms[k] = size > 0 && std::isfinite(size) ? std::log2(size) : none;
  }
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < n; ++i) {
      double largest = none;
      for (std::size_t j = 0; j < n; ++j)
        largest = std::max(largest, logarithms[i * n + j] - exponent[i] - exponent[j]);
      change[i] = largest == none ? 0 : largest / 2;
    }
    for (std::size_t i = 0; i < n; ++i) exponent[i] += change[i];
  }
  const auto [least, most] = std::minmax_element(exponent.begin(), exponent.end());
  std::vector<T> units;
  if (*most - *least > std::log2(ordinary))
    for (const double x : exponent) units.push_back(T(std::exp2(-std::round(x))));
  return units;
}

template <class T>
CongruenceDifference<T> in_units(CongruenceDifference<T> difference, const std::vector<T>& units) {
  difference.entries = in_units(std::move(difference.entries), units, 1, 1);
  difference.sizes = in_units(std::move(difference.sizes), units, 1, 1);
  return difference;
}

template struct CongruenceDifference<double>;
template struct CongruenceDifference<Quad>;
template double congruence_residual(const CongruenceDifference<double>&);
template Quad congruence_residual(const CongruenceDifference<Quad>&);
template std::vector<double> equilibrating_units(const Congruence<double>&);
template std::vector<Quad> equilibrating_units(const Congruence<Quad>&);
template CongruenceDifference<double> in_units(CongruenceDifference<double>, const std::vector<double>&);
template CongruenceDifference<Quad> in_units(CongruenceDifference<Quad>, const std::vector<Quad>&);

}  // namespace pfaff
