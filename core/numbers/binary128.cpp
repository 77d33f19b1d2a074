#include <emmintrin.h>

#include <bit>
#include <cstdint>

#include <pfaff/core/numbers/binary128.hpp>

namespace pfaff {

namespace {

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
Encoded encoded(__float128 x) {
  const auto halves = std::bit_cast<__m128i>(x);
  return {static_cast<Half>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(halves, halves))),
          static_cast<Half>(_mm_cvtsi128_si64(halves))};
}
__float128 decoded(Half high, Half low) {
  return std::bit_cast<__float128>(_mm_unpacklo_epi64(_mm_cvtsi64_si128(static_cast<long long>(low)),
                                                      _mm_cvtsi64_si128(static_cast<long long>(high))));
}

unsigned exponent_of(Half high) { return static_cast<unsigned>(high >> 48) & special_exponent; }
bool is_normal(int exponent) { return static_cast<unsigned>(exponent - 1) < special_exponent - 1; }

// The significand of a normal number as an integer of 113 bits, times 2^shift, shift in 1...15.
Encoded significand(Encoded x, int shift) {
  return {(((x.high & fraction_of_high) | leading_bit) << shift) | (x.low >> (64 - shift)), x.low << shift};
}

// The number nearest to m 2^(exponent - exponent_bias - 127), the even one of two, for 2^127 <= m < 2^128. A
// carry out of the fraction raises the exponent by itself, to that of infinity if need be.
__float128 rounded(Half sign, int exponent, Encoded m) {
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
  if ((larger_exponent == special_exponent) | (smaller_exponent == 0)) [[unlikely]]
    return a + b;

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
  if (!is_normal(x_exponent) || !is_normal(y_exponent)) [[unlikely]]
    return a * b;

  // Leading bits at 127: the upper 128 bits of the product of 256 have theirs at 127 or 126. Whether the
  // lower ones are zero is remembered in the lowest bit.
  const Encoded m = significand(x, 15), n = significand(y, 15);
  const Whole lowest = Whole{m.low} * n.low;
  const Whole middle = Whole{m.low} * n.high + static_cast<Half>(lowest >> 64);
  const Whole also_middle = Whole{m.high} * n.low + static_cast<Half>(middle);
  const Whole highest =
      Whole{m.high} * n.high + static_cast<Half>(middle >> 64) + static_cast<Half>(also_middle >> 64);
  const Half rest = static_cast<Half>(lowest) | static_cast<Half>(also_middle);
  Encoded product{static_cast<Half>(highest >> 64),
                  static_cast<Half>(highest) | static_cast<Half>(rest != 0)};
  const auto carried = static_cast<int>(product.high >> 63);
  const int shift = 1 - carried;
  product = {(product.high << shift) | ((product.low >> 63) & static_cast<Half>(shift)),
             product.low << shift};
  const int exponent = x_exponent + y_exponent - exponent_bias + carried;
  if (!is_normal(exponent)) [[unlikely]]
    return a * b;
  return rounded((x.high ^ y.high) & sign_bit, exponent, product);
}

}  // namespace pfaff
