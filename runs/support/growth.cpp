#include <pfaff/runs/support/growth.hpp>

#include <algorithm>
#include <cmath>

namespace pfaff {

namespace {
double weighted_slope(const std::vector<double>& x, const std::vector<double>& y,
                      const std::vector<double>& weight) {
  double sum = 0, mean_x = 0, mean_y = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    sum += weight[k];
    mean_x += weight[k] * x[k];
    mean_y += weight[k] * y[k];
  }
  mean_x /= sum;
  mean_y /= sum;
  double above = 0, below = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    above += weight[k] * (x[k] - mean_x) * (y[k] - mean_y);
    below += weight[k] * (x[k] - mean_x) * (x[k] - mean_x);
  }
  return above / below;
}
}  // namespace

std::optional<Growth> growth(const std::vector<double>& times, const std::vector<double>& values) {
  std::vector<double> t, log_t, log_r, alike_in_t, alike_in_log;
  double largest = 0, before = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(values[k])) return std::nullopt;
    if (times[k] <= 0) continue;
    largest = std::max(largest, std::abs(values[k]));
    if (largest > 0) {
      t.push_back(times[k]);
      log_t.push_back(std::log(times[k]));
      log_r.push_back(std::log(largest));
      alike_in_t.push_back(times[k] - before);
      alike_in_log.push_back((times[k] - before) / times[k]);
    }
    before = times[k];
  }
  if (t.size() < 8 || t.back() < 4 * t.front()) return std::nullopt;
  return Growth{weighted_slope(log_t, log_r, alike_in_log), weighted_slope(t, log_r, alike_in_t)};
}

}  // namespace pfaff
