#include <pfaff/runs/support/scales.hpp>

#include <algorithm>
#include <cmath>

namespace pfaff {

std::vector<double> scales_of(const std::vector<double>& sizes) {
  constexpr double ordinary = 64;
  const double largest = sizes.empty() ? 0 : *std::max_element(sizes.begin(), sizes.end());
  std::vector<double> scales;
  for (const double known : sizes) {
    const double size = known == 0 ? largest : known;
    const bool as_it_is = !(size > 0) || !std::isfinite(size) || (size >= 1 / ordinary && size <= ordinary);
    scales.push_back(as_it_is ? 1 : std::exp2(std::round(std::log2(size))));
  }
  return scales;
}

}  // namespace pfaff
