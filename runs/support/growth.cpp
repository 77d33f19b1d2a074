#include <pfaff/runs/support/growth.hpp>

#include <algorithm>
#include <cmath>

namespace pfaff {

void GrowthFit::Line::add(double x, double y, double weight) {
  weights += weight;
  const double dx = x - mean_x, dy = y - mean_y;
  mean_x += dx * weight / weights;
  mean_y += dy * weight / weights;
  products += weight * dx * (y - mean_y);
  squares += weight * dx * (x - mean_x);
}

void GrowthFit::add(double time, double value) {
  finite_ = finite_ && std::isfinite(value);
  if (!finite_ || time <= 0) return;
  largest_ = std::max(largest_, std::abs(value));
  const double weight = time - before_;
  before_ = time;
  if (largest_ == 0) return;
  in_log_.add(std::log(time), std::log(largest_), weight / time);
  in_t_.add(time, std::log(largest_), weight);
  if (taken_++ == 0) first_ = time;
  last_ = time;
}

std::optional<Growth> GrowthFit::growth() const {
  if (!finite_ || taken_ < 8 || last_ < 4 * first_) return std::nullopt;
  return Growth{in_log_.slope(), in_t_.slope()};
}

}  // namespace pfaff
