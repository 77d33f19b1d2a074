#include <pfaff/runs/support/walk_exponent.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/runs/support/window_models.hpp>
#include <pfaff/runs/support/windows.hpp>

namespace pfaff::windows {

namespace {

using Vector = std::vector<double>;

constexpr double exponent_step = 0.025;
constexpr std::size_t exponent_count = 38;  // .05 ... .975

double exponent_at(std::size_t k) { return 0.05 + exponent_step * double(k); }

/// sum_g w(g) w(g + m) of a window's weights, m = 0 ... 31.
Vector autocorrelation() {
  constexpr std::size_t points = 2 * points_in_half;
  Vector weights(points), products(points);
  double sum = 0;
  for (std::size_t g = 0; g < points; ++g)
    sum += weights[g] = hann((double(g) + 0.5) / double(points), 0.5, 1);
  for (std::size_t m = 0; m < points; ++m)
    for (std::size_t g = 0; g + m < points; ++g) products[m] += weights[g] * weights[g + m] / (sum * sum);
  return products;
}

/// Covariances of the differences of neighbouring means, at distances 0 ... count - 1, from those of the
/// means.
template <class OfMeans>
Vector of_differences(std::size_t count, const OfMeans& g) {
  Vector result;
  for (int k = 0; k < int(count); ++k) result.push_back(2 * g(k) - g(std::abs(k - 1)) - g(k + 1));
  return result;
}

/// log L at the best scale, of differences whose covariance depends on their distance; by Cholesky's factors.
double log_likelihood(const Vector& covariance, const Vector& differences) {
  const std::size_t n = differences.size();
  Vector lower(n * n), white(n);
  double logs = 0, square = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = covariance[i - j];
      for (std::size_t k = 0; k < j; ++k) sum -= lower[i * n + k] * lower[j * n + k];
      lower[i * n + j] = i == j ? std::sqrt(sum) : sum / lower[j * n + j];
    }
    double sum = differences[i];
    for (std::size_t k = 0; k < i; ++k) sum -= lower[i * n + k] * white[k];
    white[i] = sum / lower[i * n + i];
    square += white[i] * white[i];
    logs += std::log(lower[i * n + i]);
  }
  return -logs - 0.5 * double(n) * std::log(square);
}

/// Covariances of the differences of `count` + 1 means, of length one: of the walk of every exponent, and of
/// white noise.
struct WalkTables {
  std::vector<Vector> walks;
  Vector noise;
};
WalkTables make_tables(std::size_t count) {
  const Vector products = autocorrelation();
  const auto scaled = [](Vector x) {
    for (std::size_t k = x.size(); k-- > 0;) x[k] /= x[0];
    return x;
  };
  WalkTables tables;
  tables.noise = scaled(of_differences(count, [&](int k) {
    const std::size_t m = std::size_t(k) * points_in_half;
    return m < products.size() ? products[m] : 0;
  }));
  for (std::size_t e = 0; e < exponent_count; ++e)
    tables.walks.push_back(scaled(of_differences(count, [&](int k) {
      double sum = 0;
      for (int m = 1 - int(products.size()); m < int(products.size()); ++m)
        sum -= 0.5 * products[std::size_t(std::abs(m))] *
               std::pow(std::abs(double(m + k * int(points_in_half))), 2 * exponent_at(e));
      return sum;
    })));
  return tables;
}

}  // namespace

Estimate walk_exponent(const std::vector<double>& means) {
  static const WalkTables tables = make_tables(many_windows - 1);
  Vector differences;
  for (std::size_t i = 1; i < means.size(); ++i) differences.push_back(means[i] - means[i - 1]);
  const std::size_t n = differences.size();
  Vector likelihood, covariance(n);
  for (const Vector& walk : tables.walks) {
    double best = -std::numeric_limits<double>::infinity();
    for (const double share : {0.0, 0.05, 0.2}) {
      for (std::size_t k = 0; k < n; ++k) covariance[k] = walk[k] + share * (tables.noise[k] - walk[k]);
      best = std::max(best, log_likelihood(covariance, differences));
    }
    likelihood.push_back(best);
  }
  const auto at = std::size_t(std::max_element(likelihood.begin(), likelihood.end()) - likelihood.begin());
  std::size_t low = at, high = at;
  while (low > 0 && likelihood[low - 1] > likelihood[at] - 1.92) --low;
  while (high + 1 < exponent_count && likelihood[high + 1] > likelihood[at] - 1.92) ++high;
  return {exponent_at(at), exponent_at(low) - exponent_step / 2, exponent_at(high) + exponent_step / 2};
}

}  // namespace pfaff::windows
