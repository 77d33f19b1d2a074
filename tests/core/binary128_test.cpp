// Sums and products of binary128 numbers against the compiler's run-time library, bit by bit.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace {
using namespace pfaff;

using Bits = std::array<std::uint64_t, 2>;  // low, high
constexpr std::uint64_t sign = 1ULL << 63, fraction = (1ULL << 48) - 1;

__float128 number(std::uint64_t high, std::uint64_t low) {
  return std::bit_cast<__float128>(Bits{low, high});
}

// Equal bits; of what is no number only that it is none, because the standard leaves its bits open.
bool same(__float128 a, __float128 b) {
  return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b) || (a != a && b != b);
}

std::string shown(__float128 x) { return to_string(Quad(x)); }

// The neighbourhood of every border: of zeros, subnormal and normal numbers, one, powers of two, infinities.
std::vector<__float128> borders() {
  std::vector<__float128> found;
  for (const std::uint64_t exponent : {0x0000, 0x0001, 0x0002, 0x0070, 0x0071, 0x1fff, 0x2000, 0x2001, 0x3f8d,
                                       0x3f8e, 0x3f8f, 0x3fbf, 0x3fc0, 0x3ffd, 0x3ffe, 0x3fff, 0x4000, 0x403f,
                                       0x4070, 0x4071, 0x5ffe, 0x5fff, 0x7ffd, 0x7ffe, 0x7fff}) {
    for (const std::uint64_t high :
         {std::uint64_t{0}, std::uint64_t{1}, fraction - 1, fraction, fraction / 2 + 1}) {
      for (const std::uint64_t low :
           {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{2}, ~std::uint64_t{0}, sign}) {
        found.push_back(number((exponent << 48) | high, low));
        found.push_back(number(sign | (exponent << 48) | high, low));
      }
    }
  }
  return found;
}

TEST(Binary128, EveryPairOfBordersHasTheBitsOfTheRunTimeLibrary) {
  const auto numbers = borders();
  for (const __float128 a : numbers) {
    for (const __float128 b : numbers) {
      ASSERT_TRUE(same(binary128_sum(a, b), a + b)) << shown(a) << " + " << shown(b);
      ASSERT_TRUE(same(binary128_product(a, b), a * b)) << shown(a) << " * " << shown(b);
    }
  }
}

// Numbers of one kind: any bits; near one, so that sums overlap; few bits, so that ties are frequent;
// subnormal; near the largest; of exponents whose products are near the smallest.
__float128 of_kind(std::uint64_t kind, std::mt19937_64& random) {
  std::uint64_t high = random(), low = random();
  const auto with_exponent = [&](std::uint64_t exponent) {
    high = (high & (sign | fraction)) | (exponent << 48);
  };
  if (kind == 1) with_exponent(0x3fff - random() % 120);
  if (kind == 2) {
    with_exponent(0x3fff - random() % 3);
    low &= ~std::uint64_t{0} << (random() % 64);
    if (random() % 2 == 0) low = 0;
    if (random() % 3 == 0) high &= ~std::uint64_t{0xffffffff};
  }
  if (kind == 3) with_exponent(random() % 3 == 0 ? random() % 200 : 0);
  if (kind == 4) with_exponent(0x7fff - random() % 4);
  if (kind == 5) with_exponent(0x2000 - random() % 130);
  return number(high, low);
}

TEST(Binary128, RandomNumbersOfEveryKindHaveTheBitsOfTheRunTimeLibrary) {
  std::mt19937_64 random(128);
  for (int k = 0; k < 2'000'000; ++k) {
    const __float128 a = of_kind(random() % 6, random);
    // Also the same number and its opposite, and neighbours, which cancel.
    __float128 b = of_kind(random() % 6, random);
    if (k % 7 == 0) b = k % 2 == 0 ? a : -a;
    if (k % 11 == 0) {
      auto [low, high] = std::bit_cast<Bits>(-a);
      b = number(high, low + random() % 5 - 2);
    }
    ASSERT_TRUE(same(binary128_sum(a, b), a + b)) << shown(a) << " + " << shown(b);
    ASSERT_TRUE(same(binary128_product(a, b), a * b)) << shown(a) << " * " << shown(b);
  }
}

// Compile-time constants are computed by the compiler, the same numbers at run time by the functions.
TEST(Binary128, ConstantsAreThoseOfTheRun) {
  constexpr Quad third = Quad(1) / Quad(3), difference = third - Quad(0.333), square = third * third;
  const Quad x = std::bit_cast<Quad>(std::bit_cast<Bits>(third));
  EXPECT_TRUE(same((x - Quad(0.333)).native(), difference.native()));
  EXPECT_TRUE(same((x * x).native(), square.native()));
}

}  // namespace
