#include <pfaff/verify/rounding_of_step.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace pfaff {

bool scatter(std::span<const double> residuals) {
  constexpr double fraction = 0.02;
  const auto count = static_cast<double>(residuals.size());
  const double sum = std::accumulate(residuals.begin(), residuals.end(), 0.0);
  double squares = 0;
  for (const double r : residuals) squares += (r - sum / count) * (r - sum / count);
  return std::sqrt(squares / (count - 1)) > fraction * sum / count;
}

bool is_rounding(std::span<const double> residuals, double tolerance) {
  return scatter(residuals) && std::all_of(residuals.begin(), residuals.end(),
                                           [&](double r) { return r <= most_multiplied * tolerance; });
}

bool falls_with_the_precision(double in_double, double in_quad) { return in_quad <= most_in_quad(in_double); }
double most_in_quad(double in_double, bool scatters) {
  constexpr double fall = 1e13;
  return in_double <= (scatters ? 1e-4 : 1e-8) ? in_double / fall : -1;
}

template <class T>
std::vector<Real> moved_by_a_unit(const std::vector<Real>& start, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::vector<Real> moved;
  for (const Real& x : start) {
    const T here(x), unit = T(2) * unit_roundoff<T>() * T(abs(here));
    moved.emplace_back(Quad((random() & 1U) != 0 ? here + unit : here - unit));
  }
  return moved;
}

template std::vector<Real> moved_by_a_unit<double>(const std::vector<Real>&, int);
template std::vector<Real> moved_by_a_unit<Quad>(const std::vector<Real>&, int);

}  // namespace pfaff
