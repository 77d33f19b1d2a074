#include <pfaff/runs/support/turning.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace pfaff {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t fewest_times = 16;

// Adds to the last angle the turn from `before` to `now`, at most half a turn either way.
void append_turn(std::vector<double>& angles, const TurningVector& before, const TurningVector& now) {
  const double along = now.x * before.x + now.y * before.y, across = now.y * before.x - now.x * before.y;
  const bool has_angle = std::isfinite(along) && std::isfinite(across) && (along != 0 || across != 0);
  angles.push_back(has_angle ? angles.back() + std::atan2(across, along) : not_a_number);
}

double weighted_product(const std::vector<double>& weights, const std::vector<double>& a,
                        const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * a[k] * b[k];
  return sum;
}

// Takes from `values` their part along `direction`, and returns how many times that was in them.
double taken_off(const std::vector<double>& weights, const std::vector<double>& direction,
                 std::vector<double>& values) {
  const double part =
      weighted_product(weights, direction, values) / weighted_product(weights, direction, direction);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= part * direction[k];
  return part;
}

}  // namespace

std::vector<double> angles_of(const std::vector<TurningVector>& vectors) {
  std::vector<double> angles;
  for (const TurningVector& vector : vectors) {
    if (angles.empty()) {
      angles.push_back(0);
    } else {
      append_turn(angles, vectors[angles.size() - 1], vector);
    }
  }
  return angles;
}

std::vector<double> angles_ahead(const std::vector<TurningVector>& vectors,
                                 const std::vector<TurningVector>& others) {
  // The angles between the pairs are those of these products, from the positive axis on.
  std::vector<TurningVector> products{{1, 0}};
  for (std::size_t k = 0; k < vectors.size(); ++k)
    products.push_back({vectors[k].x * others[k].x + vectors[k].y * others[k].y,
                        vectors[k].y * others[k].x - vectors[k].x * others[k].y});
  std::vector<double> angles = angles_of(products);
  angles.erase(angles.begin());
  return angles;
}

TurningRate turning_rate(const std::vector<double>& times, const std::vector<double>& angles) {
  if (times.size() < fewest_times || times.size() != angles.size()) return {not_a_number, not_a_number};
  // Polynomials of degree 0, 1 and 2 in the time from -1 to 1, orthogonal under the weights.
  const double half = (times.back() - times.front()) / 2, middle = times.front() + half;
  const std::vector<double> one(times.size(), 1.0);
  std::vector<double> weights, first, second, rest = angles;
  for (const double t : times) {
    const double at = (t - middle) / half, wave = std::cos(std::numbers::pi * at / 2);
    weights.push_back(wave * wave * wave * wave);
    first.push_back(at);
    second.push_back(at * at);
  }
  (void)taken_off(weights, one, first);
  (void)taken_off(weights, one, second);
  (void)taken_off(weights, first, second);
  const double slope = taken_off(weights, first, rest), curvature = taken_off(weights, second, rest);
  return {slope / half, 2 * curvature / half};
}

}  // namespace pfaff
