#include <pfaff/runs/support/scales.hpp>

#include <algorithm>
#include <cmath>

namespace pfaff {

std::vector<double> scales_of(const std::vector<double>& sizes) {
  const double largest = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
  std::vector<double> scales;
  for (const double known : sizes) {
    const double size = known <= no_size * largest ? largest : known;
    scales.push_back(size > 0 && std::isfinite(size) ? std::exp2(std::round(std::log2(size))) : 1);
  }
  return scales;
}

}  // namespace pfaff
