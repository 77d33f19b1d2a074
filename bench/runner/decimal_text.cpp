// x = m 2^e with an integer m of 53 or 113 bits. Of the powers of ten there is a table: P 2^q <= 10^k, with P
// of 192 bits, rounded down. With the k for which x 10^k has as many digits before its point as are wanted,
// these are the integer part of m P 2^(e + q), which is too small by less than m 2^(e + q). Where the rest
// behind the point is so near to 1/2 that it does not say how the last digit is rounded, and outside of the
// table, the C library decides.
#include <pfaff/bench/runner/decimal_text.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <string>

namespace pfaff {

namespace {
using Word = std::uint64_t;
__extension__ using TwoWords = unsigned __int128;

struct PowerOfTen {
  std::array<Word, 3> words;  // the least first; the last one has its highest bit
  int exponent;
};
constexpr int most_tens = 340;

// A natural number of up to 1536 bits, the least word first.
struct BigNumber {
  std::array<Word, 24> words{};
  constexpr void times_ten() {
    Word carry = 0;
    for (Word& word : words) {
      const TwoWords product = TwoWords(word) * 10 + carry;
      word = static_cast<Word>(product), carry = static_cast<Word>(product >> 64U);
    }
  }
  // Rounded down.
  constexpr void by_ten() {
    Word rest = 0;
    for (std::size_t k = words.size(); k-- > 0;) {
      const TwoWords with_rest = (TwoWords(rest) << 64U) | words[k];
      words[k] = static_cast<Word>(with_rest / 10), rest = static_cast<Word>(with_rest % 10);
    }
  }
  // The leading 192 bits of this number times 2^exponent.
  [[nodiscard]] constexpr PowerOfTen leading(int exponent) const {
    std::size_t top = words.size() - 1;
    while (words[top] == 0) --top;
    const int zeros = std::countl_zero(words[top]);
    PowerOfTen power{};
    for (std::size_t j = 0; j < 3; ++j) {
      const auto word = [&](std::size_t below) { return top >= below ? words[top - below] : 0; };
      const std::size_t below = 2 - j;
      power.words[j] = zeros == 0 ? word(below) : (word(below) << zeros) | (word(below + 1) >> (64 - zeros));
    }
    power.exponent = exponent + 64 * (static_cast<int>(top) - 2) - zeros;
    return power;
  }
};

constexpr auto powers_of_ten = [] {
  std::array<PowerOfTen, 2 * most_tens + 1> powers{};
  BigNumber up, down;  // down: 2^1535 / 10^k, of which 400 bits and more are right
  up.words.front() = 1, down.words.back() = Word{1} << 63U;
  for (std::size_t k = 0; k <= most_tens; ++k, up.times_ten(), down.by_ten()) {
    powers[most_tens - k] = down.leading(-1535);
    powers[most_tens + k] = up.leading(0);
  }
  return powers;
}();

constexpr auto pairs_of_digits = [] {
  std::array<char, 200> pairs{};
  for (std::size_t k = 0; k < 100; ++k) {
    pairs[2 * k] = static_cast<char>('0' + k / 10);
    pairs[2 * k + 1] = static_cast<char>('0' + k % 10);
  }
  return pairs;
}();
// `count` digits of x, an even number of them.
void put_digits(char* to, Word x, int count) {
  for (int k = count - 2; k >= 0; k -= 2, x /= 100) std::copy_n(&pairs_of_digits[2 * (x % 100)], 2, to + k);
}

// The digits d.ddd 10^decimal in the layout of %g, without zeros at the end.
char* lay_out(char* to, bool negative, const char* digits, int count, int decimal) {
  const int wanted = count;
  while (count > 1 && digits[count - 1] == '0') --count;
  if (negative) *to++ = '-';
  if (decimal < -4 || decimal >= wanted) {
    *to++ = digits[0];
    if (count > 1) {
      *to++ = '.';
      to = std::copy(digits + 1, digits + count, to);
    }
    *to++ = 'e';
    *to++ = decimal < 0 ? '-' : '+';
    const int size = decimal < 0 ? -decimal : decimal;
    if (size >= 100) *to++ = static_cast<char>('0' + size / 100);
    return std::copy_n(&pairs_of_digits[2 * static_cast<std::size_t>(size % 100)], 2, to);
  }
  if (decimal < 0) {
    *to++ = '0', *to++ = '.';
    to = std::fill_n(to, -1 - decimal, '0');
    return std::copy(digits, digits + count, to);
  }
  const int before = std::min(count, decimal + 1);
  to = std::fill_n(std::copy(digits, digits + before, to), decimal + 1 - before, '0');
  if (count == before) return to;
  *to++ = '.';
  return std::copy(digits + before, digits + count, to);
}

// floor(log10 2^k) for |k| below 1200.
int tens_in(int k) { return static_cast<int>((std::int64_t{k} * 1292913986) >> 32U); }

constexpr Word ten_to_the_16 = 10000000000000000U, ten_to_the_18 = 100 * ten_to_the_16;
}  // namespace

char* put_decimal(char* to, double x) {
  const auto bits = std::bit_cast<Word>(x);
  const bool negative = bits >> 63U != 0;
  const int biased = static_cast<int>(bits >> 52U & 0x7FFU);
  const auto otherwise = [&] {
    return std::to_chars(to, to + longest_decimal, x, std::chars_format::general, 17).ptr;
  };
  if (biased == 0 || biased == 0x7FF) return otherwise();  // zero and subnormal numbers; what is none
  const Word m = (bits & ((Word{1} << 52U) - 1)) | (Word{1} << 52U);
  const int e = biased - 1075;
  int decimal = tens_in(e + 52);  // or one more
  for (int attempt = 0; attempt < 2; ++attempt) {
    const int tens = 16 - decimal + most_tens;
    const PowerOfTen& power = powers_of_ten[static_cast<std::size_t>(tens)];
    // The leading 128 bits of the power are enough. The product has 180 or 181, of which `shift` are behind
    // the point.
    const TwoWords low = TwoWords(m) * power.words[1], high = TwoWords(m) * power.words[2] + (low >> 64U);
    const int shift = -(e + power.exponent + 64);
    const int in_high = shift - 64;  // 55 to 63
    const Word integer = static_cast<Word>(high >> in_high);
    const auto rest = static_cast<Word>((high << (64 - in_high)) | (static_cast<Word>(low) >> in_high));
    constexpr Word half = Word{1} << 63U, near = 16;
    if (rest > half - near && rest < half + near) return otherwise();
    const Word rounded = integer + (rest > half ? 1 : 0);
    if (rounded >= 10 * ten_to_the_16) {
      ++decimal;
      continue;
    }
    std::array<char, 18> digits{};
    put_digits(digits.data(), rounded, 18);
    return lay_out(to, negative, digits.data() + 1, 17, decimal);
  }
  return otherwise();
}

char* put_decimal(char* to, const Quad& value) {
  const auto bits = std::bit_cast<TwoWords>(value.native());
  const bool negative = bits >> 127U != 0;
  const int biased = static_cast<int>(bits >> 112U & 0x7FFFU), e = biased - 16383 - 112;
  const auto otherwise = [&] {
    const std::string text = to_string(value, 36);
    return std::copy(text.begin(), text.end(), to);
  };
  if (e + 112 < -1000 || e + 112 > 1000) return otherwise();  // zero among them, and what is no number
  const TwoWords m = (bits & ((TwoWords(1) << 112U) - 1)) | (TwoWords(1) << 112U);
  int decimal = tens_in(e + 112);  // or one more
  for (int attempt = 0; attempt < 2; ++attempt) {
    const int tens = 35 - decimal + most_tens;
    const PowerOfTen& power = powers_of_ten[static_cast<std::size_t>(tens)];
    std::array<Word, 5> product{};
    for (std::size_t i = 0; i < 2; ++i) {
      Word carry = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        const TwoWords sum =
            TwoWords(static_cast<Word>(m >> (64 * i))) * power.words[j] + product[i + j] + carry;
        product[i + j] = static_cast<Word>(sum), carry = static_cast<Word>(sum >> 64U);
      }
      product[i + 3] = carry;
    }
    // 304 or 305 bits, of which `shift` are behind the point: words 0 and 1, and a part of word 2.
    const int shift = -(e + power.exponent), in_word = shift - 128;  // 52 to 61
    const auto two = [&](std::size_t k) { return (TwoWords(product[k + 1]) << 64U) | product[k]; };
    const TwoWords integer = (two(3) << (64 - in_word)) | (product[2] >> in_word);
    const TwoWords rest = (two(1) << (64 - in_word)) | (product[0] >> in_word);
    constexpr TwoWords half = TwoWords(1) << 127U, near = TwoWords(1) << 64U;
    if (rest > half - near && rest < half + near) return otherwise();
    const TwoWords rounded = integer + (rest > half ? 1 : 0);
    constexpr TwoWords limit = TwoWords(ten_to_the_18) * ten_to_the_18;
    if (rounded >= limit) {
      ++decimal;
      continue;
    }
    std::array<char, 36> digits{};
    put_digits(digits.data(), static_cast<Word>(rounded / ten_to_the_18), 18);
    put_digits(digits.data() + 18, static_cast<Word>(rounded % ten_to_the_18), 18);
    return lay_out(to, negative, digits.data(), 36, decimal);
  }
  return otherwise();
}

}  // namespace pfaff
