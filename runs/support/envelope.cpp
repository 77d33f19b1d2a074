#include <pfaff/runs/support/envelope.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pfaff/runs/support/window_models.hpp>
#include <pfaff/runs/support/windows.hpp>

namespace pfaff::windows {

namespace {

using Vector = std::vector<double>;

struct Line {
  double slope, slope_error, scatter;
};
Line line_through(const Vector& x, const Vector& y, std::size_t begin, std::size_t end) {
  const double n = double(end - begin);
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t i = begin; i < end; ++i) mean_x += x[i] / n, mean_y += y[i] / n;
  for (std::size_t i = begin; i < end; ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  const double square = std::max(yy - xy * xy / xx, 0.0);
  return {xy / xx, n > 2 ? std::sqrt(square / (n - 2) / xx) : 0, std::sqrt(square / n)};
}

// Exponents of the search, in steps of 1/20.
constexpr int first_exponent = 2, last_exponent = 160;
double exponent_at(std::size_t k) { return double(first_exponent + int(k)) / 20; }

/// For every exponent of the search, the means of s^(2 exponent) in the windows.
const std::vector<Vector>& squares_of_powers() {
  static const std::vector<Vector> table = [] {
    constexpr std::size_t points = 400;
    std::vector<Vector> squares;
    for (int k = first_exponent; k <= last_exponent; ++k) {
      Vector square(few_windows);
      for (std::size_t j = 0; j < few_windows; ++j) {
        const double centre = double(j + 1) / double(few_windows + 1);
        double weights = 0;
        for (std::size_t i = 0; i < points; ++i) {
          const double s = centre + (2 * (double(i) + 0.5) / double(points) - 1) / double(few_windows + 1);
          const double weight = hann(s, centre, few_windows);
          weights += weight;
          square[j] += weight * std::pow(s, double(k) / 10);
        }
        square[j] /= weights;
      }
      squares.push_back(std::move(square));
    }
    return squares;
  }();
  return table;
}

}  // namespace

double rank_correlation(const std::vector<double>& values) {
  const double n = double(values.size());
  double differences = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double rank = 0;
    for (std::size_t j = 0; j < values.size(); ++j)
      if (values[j] < values[i] || (values[j] == values[i] && j < i)) rank += 1;
    differences += (rank - double(i)) * (rank - double(i));
  }
  return 1 - 6 * differences / (n * (n * n - 1));
}

ExponentialFit exponential_fit(const std::vector<double>& s, const std::vector<double>& sizes,
                               double agreement) {
  constexpr std::size_t fewest = 5;
  ExponentialFit result;
  result.scatter = result.power_scatter = std::numeric_limits<double>::infinity();
  if (sizes.size() < fewest || !(sizes.front() > 0)) return result;
  result.growth = sizes.back() / sizes.front();
  std::size_t start = sizes.size();
  while (start > 0 && sizes[start - 1] > 3 * sizes.front()) --start;
  Vector x, log_x, y;
  for (std::size_t i = start; i < sizes.size(); ++i) {
    x.push_back(s[i]);
    log_x.push_back(std::log(s[i]));
    y.push_back(std::log(sizes[i]));
  }
  if (x.size() < fewest) return result;
  const Line exponential = line_through(x, y, 0, x.size());
  result.scatter = exponential.scatter;
  result.power_scatter = line_through(log_x, y, 0, x.size()).scatter;
  const double reach = 4.2 * exponential.slope_error;
  result.rate = {exponential.slope, exponential.slope - reach, exponential.slope + reach};
  double slowest = std::numeric_limits<double>::infinity(), fastest = -slowest;
  for (std::size_t third = 0; third < 3; ++third) {
    const std::size_t last = x.size() - 1;
    const double slope = line_through(x, y, third * last / 3, (third + 1) * last / 3 + 1).slope;
    slowest = std::min(slowest, slope);
    fastest = std::max(fastest, slope);
  }
  const double above_floor = y.back() - y.front();
  // On its floor a series may go up and down: the sizes there count as equal.
  Vector above = sizes;
  for (std::size_t i = 0; i < start; ++i) above[i] = 0;
  result.steady = rank_correlation(above) > 0.85 && result.growth > 100 && above_floor > std::log(20.0) &&
                  result.scatter < 0.25 * std::log(result.growth) && slowest * agreement > fastest &&
                  result.rate.low > 0;
  result.grows = result.steady && result.scatter < 0.75 * result.power_scatter;
  return result;
}

std::optional<PowerFit> power_fit(const std::vector<double>& spreads) {
  const std::size_t n = spreads.size();
  // For every exponent: rms of log(spread^2 / (A^2 g + c))/2 at the best A, without and with a constant c
  // that keeps the share of the first spread's square.
  const auto scatter_of = [&](const Vector& g, double constant) {
    Vector logs;
    double mean = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double left = spreads[j] * spreads[j] - constant * spreads.front() * spreads.front();
      if (!(left > 0)) return std::numeric_limits<double>::infinity();
      logs.push_back(std::log(left / g[j]) / 2);
      mean += logs.back() / double(n);
    }
    double square = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const double whole = spreads[j] * spreads[j];
      const double fitted = g[j] * std::exp(2 * mean) + constant * spreads.front() * spreads.front();
      square += std::pow(std::log(whole / fitted) / 2, 2) / double(n);
    }
    return std::sqrt(square);
  };
  Vector scatters;
  for (const Vector& g : squares_of_powers()) {
    const double plain = scatter_of(g, 0);
    double best = plain;
    for (const double constant : {0.3, 0.5, 0.7, 0.8, 0.9, 0.95})
      best = std::min(best, scatter_of(g, constant));
    scatters.push_back(best < 0.7 * plain ? best : plain);
  }
  const auto at = std::size_t(std::min_element(scatters.begin(), scatters.end()) - scatters.begin());
  if (at == 0 || at + 1 == scatters.size()) return std::nullopt;
  // The likelihood of n - 3 logarithms, of which neighbours share half their samples: half as many count.
  const double freedom = double(n - 3) / 2, least = std::max(scatters[at], 1e-6);
  std::size_t low = at, high = at;
  const auto within = [&](std::size_t k) {
    return freedom * std::log(std::max(scatters[k], 1e-6) / least) < 1.92;
  };
  while (low > 0 && within(low - 1)) --low;
  while (high + 1 < scatters.size() && within(high + 1)) ++high;
  return PowerFit{{exponent_at(at), exponent_at(low) - 0.025, exponent_at(high) + 0.025}, scatters[at]};
}

}  // namespace pfaff::windows
