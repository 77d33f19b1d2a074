#include <pfaff/runs/support/windows.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pfaff::windows {

Block merged(const Block& a, const Block& b) {
  const std::size_t count = a.count + b.count;
  const double share = double(b.count) / double(count);
  const auto mean = [share](double x, double y) { return x + share * (y - x); };
  const bool low_in_a = a.minimum <= b.minimum, high_in_a = a.maximum >= b.maximum;
  bool minimum_first = low_in_a;
  if (low_in_a && high_in_a) minimum_first = a.minimum_first;
  if (!low_in_a && !high_in_a) minimum_first = b.minimum_first;
  return {count,
          mean(a.time, b.time),
          mean(a.mean, b.mean),
          std::min(a.minimum, b.minimum),
          std::max(a.maximum, b.maximum),
          mean(a.mean_square, b.mean_square),
          minimum_first};
}

Series on_scaled_time(std::vector<Block> blocks, double first_time, double last_time) {
  Series series;
  for (const Block& block : blocks) series.samples += block.count;
  const double n = double(series.samples);
  series.span = (last_time - first_time) * n / (n - 1);
  const double origin = first_time - series.span / (2 * n);
  for (const Block& block : blocks) series.s.push_back((block.time - origin) / series.span);
  series.blocks = std::move(blocks);
  return series;
}

double hann(double s, double centre, std::size_t count) {
  const double x = (s - centre) * double(count + 1);
  return std::abs(x) < 1 ? 1 + std::cos(std::numbers::pi * x) : 0;
}

Windows over_windows(const Series& series, std::size_t count) {
  Windows result;
  std::size_t first = 0;
  for (std::size_t j = 1; j <= count; ++j) {
    const double centre = double(j) / double(count + 1), begin = double(j - 1) / double(count + 1),
                 end = double(j + 1) / double(count + 1);
    while (first < series.s.size() && series.s[first] <= begin) ++first;
    double weights = 0, mean = 0;
    for (std::size_t i = first; i < series.s.size() && series.s[i] < end; ++i) {
      const double weight = double(series.blocks[i].count) * hann(series.s[i], centre, count);
      weights += weight;
      mean += weight * series.blocks[i].mean;
    }
    if (!(weights > 0)) return {};
    mean /= weights;
    double square = 0;
    for (std::size_t i = first; i < series.s.size() && series.s[i] < end; ++i) {
      const Block& block = series.blocks[i];
      const double away = block.mean - mean;
      const double within = std::max(block.mean_square - block.mean * block.mean, 0.0);
      square += double(block.count) * hann(series.s[i], centre, count) * (within + away * away);
    }
    result.mean.push_back(mean);
    result.spread.push_back(std::sqrt(square / weights));
  }
  return result;
}

}  // namespace pfaff::windows
