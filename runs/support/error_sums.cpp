#include <pfaff/runs/support/error_sums.hpp>

#include <array>
#include <cstring>

namespace pfaff::sums {

namespace {
// Eight errors at a time: the compiler does not reorder sums by itself.
constexpr std::size_t width = 8;
using Numbers [[gnu::vector_size(width * sizeof(double))]] = double;
using Counts [[gnu::vector_size(width * sizeof(double))]] = long long;

Numbers load(const double* from) {
  Numbers numbers;
  std::memcpy(&numbers, from, sizeof(numbers));
  return numbers;
}

void take(Sums& sums, double low, double high, std::size_t at_low, std::size_t at_high) {
  if (low < sums.low || (low == sums.low && at_low < sums.first_low)) sums.low = low, sums.first_low = at_low;
  if (high > sums.high || (high == sums.high && at_high < sums.first_high))
    sums.high = high, sums.first_high = at_high;
}

// Takes the errors from the second on, eight at a time, into sums that hold the first alone; returns how many
// errors are taken then.
std::size_t take_eights(std::span<const double> errors, Sums& sums) {
  const double* const e = errors.data();
  std::size_t k = 1;
  Numbers sum{}, square{}, ramp{}, low = Numbers{} + e[0], high = low, at_low{}, at_high{},
                                   index{1, 2, 3, 4, 5, 6, 7, 8};
  Counts up{}, down{};
  for (; k + width <= errors.size(); k += width) {
    const Numbers x = load(e + k), previous = load(e + k - 1), d = x - sums.shift;
    sum += d;
    square += d * d;
    ramp += index * d;
    at_low = x < low ? index : at_low;
    low = x < low ? x : low;
    at_high = x > high ? index : at_high;
    high = x > high ? x : high;
    up -= x > previous;  // a comparison that holds is -1
    down -= x < previous;
    index += static_cast<double>(width);
  }
  for (std::size_t j = 0; j < width; ++j) {
    sums.sum += sum[j], sums.square += square[j], sums.ramp += ramp[j];
    take(sums, low[j], high[j], static_cast<std::size_t>(at_low[j]), static_cast<std::size_t>(at_high[j]));
    sums.rises += static_cast<std::size_t>(up[j]), sums.falls += static_cast<std::size_t>(down[j]);
  }
  return k;
}
}  // namespace

Sums of(std::span<const double> errors, double before) {
  const double* const e = errors.data();
  const std::size_t n = errors.size();
  Sums sums{.shift = e[0], .low = e[0], .high = e[0], .count = n};
  sums.rises = e[0] > before ? 1 : 0, sums.falls = e[0] < before ? 1 : 0;
  std::size_t k = n > width ? take_eights(errors, sums) : 1;
  for (; k < n; ++k) {
    const double d = e[k] - sums.shift;
    sums.sum += d, sums.square += d * d, sums.ramp += static_cast<double>(k) * d;
    take(sums, e[k], e[k], k, k);
    sums.rises += e[k] > e[k - 1] ? 1 : 0, sums.falls += e[k] < e[k - 1] ? 1 : 0;
  }
  return sums;
}

windows::Block block_of(const Sums& sums, double t, double dt) {
  const auto count = static_cast<double>(sums.count);
  const double mean_square = (sums.square + sums.shift * (2 * sums.sum + count * sums.shift)) / count;
  return {sums.count,  t + dt * (count - 1) / 2,         sums.shift + sums.sum / count, sums.low, sums.high,
          mean_square, sums.first_low <= sums.first_high};
}

}  // namespace pfaff::sums
