#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include <pfaff/core/numbers/binary128.hpp>

namespace pfaff {

namespace {

// The parts of an operation are inlined without optimisation too: under the sanitizers most of the tests'
// time is arithmetic in quad.

// A binary128 number: sign, 15 bits of exponent, 112 bits of fraction, in two halves.
using Half = std::uint64_t;
__extension__ typedef unsigned __int128 Whole;  // NOLINT(modernize-use-using): `using` takes no __extension__
struct Encoded {
  Half high, low;
};
constexpr int exponent_bias = 16383;
constexpr unsigned special_exponent = 0x7fff;  // of infinities and of what is no number
constexpr Half sign_bit = Half{1} << 63;
constexpr Half leading_bit = Half{1} << 48;  // of a significand, not stored
constexpr Half fraction_of_high = leading_bit - 1;

// Between registers, because a load of sixteen bytes waits for two stores of eight.
[[gnu::always_inline]] inline Encoded encoded(__float128 x) {
  const auto halves = std::bit_cast<__m128i>(x);
  return {static_cast<Half>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(halves, halves))),
          static_cast<Half>(_mm_cvtsi128_si64(halves))};
}
[[gnu::always_inline]] inline __float128 decoded(Half high, Half low) {
  return std::bit_cast<__float128>(_mm_unpacklo_epi64(_mm_cvtsi64_si128(static_cast<long long>(low)),
                                                      _mm_cvtsi64_si128(static_cast<long long>(high))));
}

[[gnu::always_inline]] inline unsigned exponent_of(Half high) {
  return static_cast<unsigned>(high >> 48) & special_exponent;
}
[[gnu::always_inline]] inline bool is_normal(int exponent) {
  return static_cast<unsigned>(exponent - 1) < special_exponent - 1;
}

[[gnu::always_inline]] inline bool is_zero(Encoded x) { return ((x.high & ~sign_bit) | x.low) == 0; }

// The significand of a normal number as an integer of 113 bits, times 2^shift, shift in 1...15.
[[gnu::always_inline]] inline Encoded significand(Encoded x, int shift) {
  return {(((x.high & fraction_of_high) | leading_bit) << shift) | (x.low >> (64 - shift)), x.low << shift};
}

// 256 bits, in two halves.
struct Product {
  Whole upper, lower;
};
[[gnu::always_inline]] inline Product product_of(Encoded m, Encoded n) {
  const Whole lowest = Whole{m.low} * n.low;
  const Whole middle = Whole{m.low} * n.high + static_cast<Half>(lowest >> 64);
  const Whole also_middle = Whole{m.high} * n.low + static_cast<Half>(middle);
  return {Whole{m.high} * n.high + static_cast<Half>(middle >> 64) + static_cast<Half>(also_middle >> 64),
          also_middle << 64 | static_cast<Half>(lowest)};
}

// The number nearest to m 2^(exponent - exponent_bias - 127), the even one of two, for 2^127 <= m < 2^128. A
// carry out of the fraction raises the exponent by itself, to that of infinity if need be.
[[gnu::always_inline]] inline __float128 rounded(Half sign, int exponent, Encoded m) {
  const Half up = ((m.low & 0x7fff) + 0x3fff + ((m.low >> 15) & 1)) >> 15;
  const Half low = ((m.high << 49) | (m.low >> 15)) + up;
  const Half high = (m.high >> 15) + (static_cast<Half>(exponent - 1) << 48) + static_cast<Half>(low < up);
  return decoded(high | sign, low);
}

}  // namespace

__float128 binary128_sum(__float128 a, __float128 b) noexcept {
  const Encoded x = encoded(a), y = encoded(b);
  const Half x_high = x.high & ~sign_bit, y_high = y.high & ~sign_bit;
  // Without branches, which nobody can predict here.
  const Half swap = -static_cast<Half>((x_high < y_high) | ((x_high == y_high) & (x.low < y.low)));
  const Encoded change{(x.high ^ y.high) & swap, (x.low ^ y.low) & swap};
  const Encoded larger{x.high ^ change.high, x.low ^ change.low},
      smaller{y.high ^ change.high, y.low ^ change.low};
  const unsigned larger_exponent = exponent_of(larger.high), smaller_exponent = exponent_of(smaller.high);
  if ((larger_exponent == special_exponent) | (smaller_exponent == 0)) [[unlikely]] {
    // A zero leaves the other number as it is; many coefficients of series are zero.
    if (larger_exponent == special_exponent || !is_zero(smaller)) return a + b;
    return is_zero(larger) ? decoded(x.high & y.high, 0) : decoded(larger.high, larger.low);
  }

  // Leading bits at 126, which leaves room for a carry and 14 bits below the last one. What is shifted out is
  // remembered in the lowest bit, which suffices to round.
  const Encoded m = significand(larger, 14);
  Encoded n = significand(smaller, 14);
  const unsigned shift = larger_exponent - smaller_exponent;
  if (shift < 64) [[likely]] {
    const Half lost = n.low & ((Half{1} << shift) - 1);
    n = {n.high >> shift, (n.low >> shift) | ((n.high << 1) << (63 - shift)) | static_cast<Half>(lost != 0)};
  } else if (shift < 128) {
    const Half lost = n.low | (n.high & ((Half{1} << (shift - 64)) - 1));
    n = {0, (n.high >> (shift - 64)) | static_cast<Half>(lost != 0)};
  } else {
    n = {0, 0};  // too small to be seen
  }
  const Half opposite = -((larger.high ^ smaller.high) >> 63);  // all bits if the signs differ
  const Whole total = ((Whole{m.high} << 64) | m.low) +
                      ((Whole{n.high ^ opposite} << 64) | (n.low ^ opposite)) + (opposite & 1);
  Encoded sum{static_cast<Half>(total >> 64), static_cast<Half>(total)};
  int zeros = 0;
  if (sum.high != 0) [[likely]] {
    zeros = std::countl_zero(sum.high);
    sum = {(sum.high << zeros) | ((sum.low >> 1) >> (63 - zeros)), sum.low << zeros};
  } else if (sum.low != 0) {
    zeros = 64 + std::countl_zero(sum.low);
    sum = {sum.low << (zeros - 64), 0};
  } else {
    return 0;
  }
  const int exponent = static_cast<int>(larger_exponent) + 1 - zeros;
  if (!is_normal(exponent)) [[unlikely]]
    return a + b;
  return rounded(larger.high & sign_bit, exponent, sum);
}

__float128 binary128_product(__float128 a, __float128 b) noexcept {
  const Encoded x = encoded(a), y = encoded(b);
  const auto x_exponent = static_cast<int>(exponent_of(x.high)),
             y_exponent = static_cast<int>(exponent_of(y.high));
  if (!is_normal(x_exponent) || !is_normal(y_exponent)) [[unlikely]] {
    const bool finite = exponent_of(x.high) != special_exponent && exponent_of(y.high) != special_exponent;
    return finite && (is_zero(x) || is_zero(y)) ? decoded((x.high ^ y.high) & sign_bit, 0) : a * b;
  }

  // Leading bits at 127: the upper 128 bits of the product of 256 have theirs at 127 or 126. Whether the
  // lower ones are zero is remembered in the lowest bit.
  const Product p = product_of(significand(x, 15), significand(y, 15));
  Encoded product{static_cast<Half>(p.upper >> 64),
                  static_cast<Half>(p.upper) | static_cast<Half>(p.lower != 0)};
  const auto carried = static_cast<int>(product.high >> 63);
  const int shift = 1 - carried;
  product = {(product.high << shift) | ((product.low >> 63) & static_cast<Half>(shift)),
             product.low << shift};
  const int exponent = x_exponent + y_exponent - exponent_bias + carried;
  if (!is_normal(exponent)) [[unlikely]]
    return a * b;
  return rounded((x.high ^ y.high) & sign_bit, exponent, product);
}

namespace {

// Of a number in memory, whose halves are loaded one by one.
[[gnu::always_inline]] inline Encoded encoded_at(const __float128* x) {
  Encoded halves;
  __builtin_memcpy(&halves.low, x, sizeof(Half));
  __builtin_memcpy(&halves.high, reinterpret_cast<const char*>(x) + sizeof(Half), sizeof(Half));
  return halves;
}

// The exponents of products.
struct Exponents {
  unsigned largest = 0;  // the sum of both
  bool finite_and_not_subnormal = true;

  [[gnu::always_inline]] void look_at(Encoded x, Encoded y) {
    const unsigned x_exponent = exponent_of(x.high), y_exponent = exponent_of(y.high);
    if (is_normal(static_cast<int>(x_exponent)) && is_normal(static_cast<int>(y_exponent))) [[likely]] {
      largest = std::max(largest, x_exponent + y_exponent);
    } else if (x_exponent == special_exponent || y_exponent == special_exponent ||
               !(is_zero(x) || is_zero(y))) {
      finite_and_not_subnormal = false;
    }
  }
};

// A number of 256 bits, the lowest first.
struct Halves {
  unsigned long long parts[4] = {};
  [[gnu::always_inline]] unsigned long long& operator[](int k) { return parts[k]; }
  [[gnu::always_inline]] unsigned long long operator[](int k) const { return parts[k]; }
};

[[gnu::always_inline]] inline Halves halves_of_product(Encoded m, Encoded n) {
  const Whole lowest = Whole{m.low} * n.low, middle = Whole{m.low} * n.high,
              also_middle = Whole{m.high} * n.low, highest = Whole{m.high} * n.high;
  const auto low = [](Whole x) { return static_cast<unsigned long long>(x); };
  const auto high = [](Whole x) { return static_cast<unsigned long long>(x >> 64); };
  Halves p;
  p[0] = low(lowest);
  unsigned char carry = _addcarry_u64(0, low(middle), high(lowest), &p[1]);
  _addcarry_u64(carry, high(middle), 0, &p[2]);  // a half of a product is below the largest number
  carry = _addcarry_u64(0, p[1], low(also_middle), &p[1]);
  carry = _addcarry_u64(carry, p[2], high(also_middle), &p[2]);
  _addcarry_u64(carry, high(highest), 0, &p[3]);
  carry = _addcarry_u64(0, p[2], low(highest), &p[2]);
  _addcarry_u64(carry, p[3], 0, &p[3]);
  return p;
}

// The sum of numbers of 256 bits, in two's complement.
class Accumulator {
 public:
  [[gnu::always_inline]] explicit Accumulator(unsigned largest) : largest_(largest) {}

  // Adds x y. The largest product that is added lies between 2^240 and 2^242, this one is 2^below times
  // smaller than by its significands; so there is room for 2^13 products, and what is dropped of each is less
  // than 2^-240 of the largest.
  [[gnu::always_inline]] void add(Encoded x, Encoded y) {
    const unsigned x_exponent = exponent_of(x.high), y_exponent = exponent_of(y.high);
    const unsigned below = largest_ - x_exponent - y_exponent;
    if (x_exponent == 0 || y_exponent == 0 || below >= 256) return;
    Halves p = halves_of_product(significand(x, 15), significand(y, 1));
    // By whole halves first, which terms of the sums of series seldom are smaller by.
    for (unsigned k = below / 64; k > 0; --k) [[unlikely]] p = {p[1], p[2], p[3], 0};
    const unsigned right = below % 64, left = 63 - right;
    const Half all = -((x.high ^ y.high) >> 63);  // ones if the product is negative
    const auto part = [&](Half low, Half high) { return ((low >> right) | ((high << 1) << left)) ^ all; };
    add({part(p[0], p[1]), part(p[1], p[2]), part(p[2], p[3]), (p[3] >> right) ^ all}, all & 1);
  }
  // Twice the sum so far.
  [[gnu::always_inline]] void redouble() { add(sum_, 0); }

  // The number nearest to the sum, where products of the exponent `largest` lie between 2^240 and 2^242.
  // False where that is not a normal number.
  [[gnu::always_inline]] bool rounded_to(__float128& result) const {
    const bool negative = sum_[3] >> 63 != 0;
    Whole upper = Whole{sum_[3]} << 64 | sum_[2], lower = Whole{sum_[1]} << 64 | sum_[0];
    if (negative) {
      lower = -lower;
      upper = ~upper + static_cast<Half>(lower == 0);
    }
    result = 0;
    if ((upper | lower) == 0) return true;
    int zeros = 0;
    if (upper == 0) {
      zeros = 128;
      upper = lower;
      lower = 0;
    }
    const auto high = static_cast<Half>(upper >> 64);
    const int more_zeros =
        high != 0 ? std::countl_zero(high) : 64 + std::countl_zero(static_cast<Half>(upper));
    if (more_zeros != 0) {
      upper = upper << more_zeros | lower >> (128 - more_zeros);
      lower <<= more_zeros;
    }
    const int exponent = static_cast<int>(largest_) - exponent_bias + 15 - zeros - more_zeros;
    if (!is_normal(exponent)) return false;
    result =
        rounded(negative ? sign_bit : 0, exponent,
                {static_cast<Half>(upper >> 64), static_cast<Half>(upper) | static_cast<Half>(lower != 0)});
    return true;
  }

 private:
  [[gnu::always_inline]] void add(Halves x, Half carry) {
    unsigned char carried = static_cast<unsigned char>(carry);
    for (int k = 0; k < 4; ++k) carried = _addcarry_u64(carried, sum_[k], x[k], &sum_[k]);
  }

  unsigned largest_;
  Halves sum_ = {};
};

constexpr Encoded one{static_cast<Half>(exponent_bias) << 48, 0};
constexpr std::size_t most_products = 1U << 12;

}  // namespace

__float128 binary128_sum_of_products(__float128 start, const __float128* a, std::ptrdiff_t a_step,
                                     const __float128* b, std::ptrdiff_t b_step, std::size_t count) noexcept {
  __float128 result = 0;
  if (count >= 2 && count < most_products) [[likely]] {
    const auto last = static_cast<std::ptrdiff_t>(count - 1);
    // The products of a square are the same from both ends.
    const bool square = a_step == -b_step && b == a + last * a_step;
    const std::size_t different = square ? count / 2 : count;
    const auto each = [&](std::size_t begin, std::size_t end, auto&& take) {
      const __float128 *x = a + static_cast<std::ptrdiff_t>(begin) * a_step,
                       *y = b + static_cast<std::ptrdiff_t>(begin) * b_step;
      for (std::size_t k = begin; k < end; ++k, x += a_step, y += b_step) take(encoded_at(x), encoded_at(y));
    };
    const std::size_t looked_at = square ? different + count % 2 : count;
    Exponents exponents;
    exponents.look_at(encoded(start), one);
    each(0, looked_at, [&](Encoded x, Encoded y) { exponents.look_at(x, y); });
    if (exponents.finite_and_not_subnormal) [[likely]] {
      Accumulator sum(exponents.largest);
      each(0, different, [&](Encoded x, Encoded y) { sum.add(x, y); });
      if (square) sum.redouble();
      each(different, looked_at, [&](Encoded x, Encoded y) { sum.add(x, y); });
      sum.add(encoded(start), one);
      if (sum.rounded_to(result)) return result;
    }
  }
  result = start;
  for (std::size_t k = 0; k < count; ++k) {
    const auto at = static_cast<std::ptrdiff_t>(k);
    result = binary128_sum(result, binary128_product(a[at * a_step], b[at * b_step]));
  }
  return result;
}

}  // namespace pfaff
