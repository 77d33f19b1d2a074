#include <pfaff/runs/support/congruence.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

namespace {
template <class T>
std::vector<T> absolute(std::vector<T> a) {
  for (T& x : a) x = abs(x);
  return a;
}
template <class T>
Matrix<T> absolute(const Matrix<T>& a) {
  return Matrix<T>(a.rows(), absolute(a.entries()));
}
}  // namespace

template <class T>
CongruenceDifference<T>::CongruenceDifference(const Congruence<T>& of)
    : entries(of.m.transposed() * (of.k1 * of.m) - of.k0),
      sizes(absolute(of.m).transposed() * (absolute(of.k1) * absolute(of.m))) {}

template <class T>
T congruence_residual(const CongruenceDifference<T>& difference) {
  T worst(0), scale(0);
  for (const T& x : difference.entries.entries()) {
    if (isnan(x)) return abs(x);
    worst = std::max(worst, T(abs(x)));
  }
  for (const T& x : difference.sizes.entries()) scale = std::max(scale, x);
  return worst / scale;
}

template <class T>
T congruence_residual(const std::vector<T>& m, const std::vector<T>& k1, const std::vector<T>& k0) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(m.size()))));
  return congruence_residual(CongruenceDifference<T>({Matrix<T>(n, m), Matrix<T>(n, k1), Matrix<T>(n, k0)}));
}

// A symmetric matrix is divided by roots of the largest numbers of its rows until these are alike.
template <class T>
std::vector<T> equilibrating_units(const Congruence<T>& of) {
  constexpr int passes = 20;
  constexpr double ordinary = 64;
  constexpr double none = -std::numeric_limits<double>::infinity();
  const std::size_t n = of.m.rows();
  const Matrix<T> moved = absolute(of.m) + Matrix<T>::identity(n);
  const Matrix<T> sizes = moved.transposed() * (absolute(of.k1) * moved);
  std::vector<double> logarithms(n * n), exponent(n), change(n);
  for (std::size_t k = 0; k < n * n; ++k) {
    const auto size = static_cast<double>(sizes.entries()[k]);
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
CongruenceDifference<T> in_units(const CongruenceDifference<T>& difference, const std::vector<T>& units) {
  const auto scaled = [&](const Matrix<T>& a) {
    return Matrix<T>(units.size(), in_units(a.entries(), units, 1, 1));
  };
  return {scaled(difference.entries), scaled(difference.sizes)};
}

template struct CongruenceDifference<double>;
template struct CongruenceDifference<Quad>;
template double congruence_residual(const CongruenceDifference<double>&);
template Quad congruence_residual(const CongruenceDifference<Quad>&);
template double congruence_residual(const std::vector<double>&, const std::vector<double>&,
                                    const std::vector<double>&);
template Quad congruence_residual(const std::vector<Quad>&, const std::vector<Quad>&,
                                  const std::vector<Quad>&);
template std::vector<double> equilibrating_units(const Congruence<double>&);
template std::vector<Quad> equilibrating_units(const Congruence<Quad>&);
template CongruenceDifference<double> in_units(const CongruenceDifference<double>&,
                                               const std::vector<double>&);
template CongruenceDifference<Quad> in_units(const CongruenceDifference<Quad>&, const std::vector<Quad>&);

}  // namespace pfaff
