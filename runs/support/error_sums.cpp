#include <pfaff/runs/support/error_sums.hpp>

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

// The lanes in another order: every lane meets the one that is so many lanes away.
template <int Away, class Of>
Of turned(const Of& x) {
  return __builtin_shufflevector(x, x, 0 ^ Away, 1 ^ Away, 2 ^ Away, 3 ^ Away, 4 ^ Away, 5 ^ Away, 6 ^ Away,
                                 7 ^ Away);
}

template <class Of>
auto sum_of_lanes(Of x) {
  x += turned<4>(x);
  x += turned<2>(x);
  x += turned<1>(x);
  return x[0];
}

// The least number that every lane has seen, and where it stood first.
struct Least {
  Numbers number, at;
  void take(const Numbers& x, const Numbers& index) {
    at = x < number ? index : at;
    number = x < number ? x : number;
  }
  template <int Away>
  void meet() {
    const Numbers x = turned<Away>(number), index = turned<Away>(at);
    const Counts before = (x < number) | ((x == number) & (index < at));
    number = before ? x : number;
    at = before ? index : at;
  }
  void of_lanes() {
    meet<4>();
    meet<2>();
    meet<1>();
  }
};

// Takes the next errors, eight at a time, as long as there are eight; returns how many are taken.
std::size_t take_eights(std::span<const double> errors, double before, Sums& sums) {
  const double* const e = errors.data();
  std::size_t k = 0;
  Numbers sum{}, square{}, ramp{}, index{0, 1, 2, 3, 4, 5, 6, 7};
  Numbers x = load(e), previous = __builtin_shufflevector(x, x, 7, 0, 1, 2, 3, 4, 5, 6);
  previous[0] = before;
  Least low{x, index}, high{-x, index};
  Counts up{}, down{};
  while (true) {
    const Numbers d = x - sums.shift;
    sum += d;
    square += d * d;
    ramp += index * d;
    low.take(x, index);
    high.take(-x, index);
    up -= x > previous;  // a comparison that holds is -1
    down -= x < previous;
    index += static_cast<double>(width);
    k += width;
    if (k + width > errors.size()) break;
    x = load(e + k), previous = load(e + k - 1);
  }
  low.of_lanes();
  high.of_lanes();
  sums.sum = sum_of_lanes(sum), sums.square = sum_of_lanes(square), sums.ramp = sum_of_lanes(ramp);
  sums.low = low.number[0], sums.first_low = static_cast<std::size_t>(low.at[0]);
  sums.high = -high.number[0], sums.first_high = static_cast<std::size_t>(high.at[0]);
  sums.rises = static_cast<std::size_t>(sum_of_lanes(up));
  sums.falls = static_cast<std::size_t>(sum_of_lanes(down));
  return k;
}
}  // namespace

Sums of(std::span<const double> errors, double before) {
  const double* const e = errors.data();
  Sums sums{.shift = e[0], .low = e[0], .high = e[0], .count = errors.size()};
  std::size_t k = errors.size() >= width ? take_eights(errors, before, sums) : 0;
  for (double previous = k > 0 ? e[k - 1] : before; k < errors.size(); previous = e[k++]) {
    const double d = e[k] - sums.shift;
    sums.sum += d, sums.square += d * d, sums.ramp += static_cast<double>(k) * d;
    if (e[k] < sums.low) sums.low = e[k], sums.first_low = k;
    if (e[k] > sums.high) sums.high = e[k], sums.first_high = k;
    sums.rises += e[k] > previous ? 1 : 0, sums.falls += e[k] < previous ? 1 : 0;
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
