// Sums of products of binary128 numbers that are rounded once, against exact integers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace {
using namespace pfaff;
using boost::multiprecision::cpp_int;

using HalvesOfQuad = std::array<std::uint64_t, 2>;  // low, high

// A number of sign and magnitude below 2, 2^down times smaller than what lies between 1 and 2.
Quad scaled_down(std::mt19937_64& random, unsigned down) {
  const std::uint64_t high = random();
  const auto digits = high & ((1ULL << 48) - 1), signed_as = high & (1ULL << 63);
  return std::bit_cast<Quad>(
      HalvesOfQuad{random(), signed_as | (std::uint64_t{0x3fff - down} << 48) | digits});
}

// The power of two with this biased exponent.
Quad of_exponent(std::uint64_t exponent) { return std::bit_cast<Quad>(HalvesOfQuad{0, exponent << 48}); }

// x 2^512, exactly, for numbers whose lowest bit is not below 2^-512.
cpp_int as_integer(Quad x) {
  const auto halves = std::bit_cast<HalvesOfQuad>(x);
  const auto exponent = static_cast<int>((halves[1] >> 48) & 0x7fff);
  if (exponent == 0) return 0;
  cpp_int m = (halves[1] & ((1ULL << 48) - 1)) | (1ULL << 48);
  m = (m << 64) | halves[0];
  m <<= static_cast<unsigned>(512 - 112 + exponent - 0x3fff);
  return (halves[1] >> 63) != 0 ? cpp_int(-m) : m;
}

// The Quad nearest to n 2^-1024, the even one of two.
Quad nearest(const cpp_int& n) {
  if (n == 0) return 0;
  const cpp_int size = abs(n);
  const auto top = static_cast<int>(msb(size));
  cpp_int m = size;
  int below = top - 112;  // the place of the last bit
  if (below > 0) {
    const cpp_int rest = size & ((cpp_int(1) << static_cast<unsigned>(below)) - 1),
                  half = cpp_int(1) << static_cast<unsigned>(below - 1);
    m = size >> static_cast<unsigned>(below);
    if (rest > half || (rest == half && (m & 1) == 1)) ++m;
  } else {
    below = 0;
  }
  const auto low = static_cast<std::uint64_t>(m & std::numeric_limits<std::uint64_t>::max());
  const auto high = static_cast<std::uint64_t>(m >> 64);
  // Both halves are exact, and so is their sum, of at most 113 bits.
  const auto of = [](std::uint64_t half) {
    return Quad(static_cast<double>(half >> 32)) * Quad(4294967296.0) +
           Quad(static_cast<double>(half & 0xffffffffU));
  };
  Quad power = 1;
  const Quad factor = below >= 1024 ? Quad(2) : Quad(0.5);
  for (int k = below; k != 1024; k += k < 1024 ? 1 : -1) power = power * factor;
  const Quad x = (of(high) * Quad(4294967296.0) * Quad(4294967296.0) + of(low)) * power;
  return n < 0 ? -x : x;
}

// Two and more, which are rounded once.
struct Products {
  Quad start;
  std::vector<Quad> a, b;  // of a, every second number; b backwards, every third
  std::size_t count;

  Products(std::mt19937_64& random, unsigned spread) : count(2 + random() % 8) {
    const auto drawn = [&] {
      return random() % 5 == 0 ? Quad(0) : scaled_down(random, static_cast<unsigned>(random() % spread));
    };
    start = drawn();
    for (std::size_t k = 0; k < 2 * count; ++k) a.push_back(drawn());
    for (std::size_t k = 0; k < 3 * count; ++k) b.push_back(drawn());
    // A product and its opposite, which cancel, and a start that is nearly the opposite of a product.
    if (random() % 3 == 0) {
      a[2] = -a[0];
      b[3 * (count - 2)] = b[3 * (count - 1)];
    }
    if (random() % 3 == 0) start = -(a[0] * b[3 * (count - 1)]);
  }
  [[nodiscard]] Quad a_of(std::size_t k) const { return a[2 * k]; }
  [[nodiscard]] Quad b_of(std::size_t k) const { return b[3 * (count - 1 - k)]; }
  [[nodiscard]] Quad rounded_once() const {
    return sum_of_products(start, a.data(), 2, b.data() + 3 * (count - 1), -3, count);
  }
  [[nodiscard]] Quad rounded_each_time() const {
    Quad sum = start;
    for (std::size_t k = 0; k < count; ++k) sum = sum + a_of(k) * b_of(k);
    return sum;
  }
  [[nodiscard]] cpp_int exact() const {
    cpp_int sum = as_integer(start) << 512U;
    for (std::size_t k = 0; k < count; ++k) sum += as_integer(a_of(k)) * as_integer(b_of(k));
    return sum;
  }
};

// Products whose exponents differ by less than 16 lose nothing before the last rounding.
TEST(SumOfProducts, IsTheNumberNearestToTheExactSum) {
  std::mt19937_64 random(1753);
  int differently = 0;
  for (int k = 0; k < 50'000; ++k) {
    const Products of(random, 8);
    const Quad expected = nearest(of.exact());
    ASSERT_TRUE(of.rounded_once() == expected)
        << k << ": " << to_string(of.rounded_once()) << " instead of " << to_string(expected);
    differently += of.rounded_each_time() == expected ? 0 : 1;
  }
  EXPECT_GT(differently, 12'500);  // roundings of every operation are seen
}

// Of products that differ more, less than 2^-240 of the largest is dropped of each.
TEST(SumOfProducts, DropsOnlyWhatIsFarBelowTheLargest) {
  std::mt19937_64 random(240);
  for (int k = 0; k < 50'000; ++k) {
    const Products of(random, 125);
    const cpp_int exact = of.exact();
    cpp_int largest = abs(as_integer(of.start)) << 512U;
    for (std::size_t i = 0; i < of.count; ++i)
      largest = std::max<cpp_int>(largest, abs(as_integer(of.a_of(i)) * as_integer(of.b_of(i))));
    const cpp_int error = abs(cpp_int(as_integer(of.rounded_once()) << 512U) - exact);
    ASSERT_LE(error, cpp_int(abs(exact) >> 113U) + (largest * 10 >> 240U)) << k;
  }
}

// A square is known by its place in memory; the same numbers in two places have the same sum.
TEST(SumOfProducts, OfASquareIsThatOfTheSameNumbersElsewhere) {
  std::mt19937_64 random(1811);
  for (int k = 0; k < 50'000; ++k) {
    const Products of(random, k % 2 == 0 ? 8 : 300);
    const std::vector<Quad> same = of.a;
    const auto square = [&](const std::vector<Quad>& other) {
      return sum_of_products(of.start, of.a.data(), 2, other.data() + 2 * (of.count - 1), -2, of.count);
    };
    ASSERT_TRUE(square(of.a) == square(same)) << k << ": " << to_string(square(of.a));
  }
}

// What has no normal numbers is computed as it is without it.
TEST(SumOfProducts, BordersOfTheRangeAreThoseOfSumsAndProducts) {
  const Quad largest = of_exponent(0x7ffe), none = Quad(0) / Quad(0), tiny = of_exponent(1);
  const auto of = [](Quad start, Quad a, Quad b) { return sum_of_products(start, &a, 1, &b, 1, 1); };
  EXPECT_TRUE(of(1, largest, 2) == Quad(1) / Quad(0));
  EXPECT_TRUE(isnan(of(1, none, 2)));
  EXPECT_TRUE(isnan(of(none, 1, 2)));
  EXPECT_TRUE(of(0, tiny, 0.25) == tiny * Quad(0.25));
  EXPECT_TRUE(of(0, tiny * Quad(0.25), 8) == tiny * Quad(2));
  EXPECT_TRUE(of(0, tiny, tiny) == Quad(0));
  EXPECT_TRUE(of(2, 0, largest) == Quad(2));
  EXPECT_TRUE(of(0, 0, 0) == Quad(0));
  EXPECT_TRUE(sum_of_products(Quad(3), nullptr, 1, nullptr, 1, 0) == Quad(3));
}
}  // namespace
