// Integers modulo the prime 2^61 - 1: a scalar in which fractions are exact and no number grows.
//
// An identity of fractions holds here too. One that does not hold in fractions holds here by chance only,
// where the prime divides the numerator of the difference: one case in 2e18, if the numbers have no part in
// its choice.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>

#include <pfaff/core/numbers/rational.hpp>

namespace pfaff::testing {
class ModuloPrime;
}

template <>
class std::numeric_limits<pfaff::testing::ModuloPrime> : public std::numeric_limits<pfaff::Rational> {};

namespace pfaff::testing {

class ModuloPrime {
 public:
  static constexpr std::uint64_t prime = (std::uint64_t(1) << 61) - 1;

  ModuloPrime() = default;
  ModuloPrime(int value)  // NOLINT(google-explicit-constructor)
      : residue_(value < 0 ? prime - static_cast<std::uint64_t>(-static_cast<std::int64_t>(value))
                           : static_cast<std::uint64_t>(value)) {}
  explicit ModuloPrime(const Rational& x) {
    const std::string text = to_string(x);
    const std::size_t end = text.find('/');
    *this = of_digits(text.substr(0, end));
    if (end != std::string::npos) *this /= of_digits(text.substr(end + 1));
  }

  ModuloPrime& operator+=(const ModuloPrime& o) { return *this = *this + o; }
  ModuloPrime& operator-=(const ModuloPrime& o) { return *this = *this - o; }
  ModuloPrime& operator*=(const ModuloPrime& o) { return *this = *this * o; }
  ModuloPrime& operator/=(const ModuloPrime& o) { return *this = *this / o; }
  friend ModuloPrime operator-(const ModuloPrime& a) { return of(a.residue_ == 0 ? 0 : prime - a.residue_); }
  friend ModuloPrime operator+(const ModuloPrime& a, const ModuloPrime& b) {
    const std::uint64_t sum = a.residue_ + b.residue_;
    return of(sum >= prime ? sum - prime : sum);
  }
  friend ModuloPrime operator-(const ModuloPrime& a, const ModuloPrime& b) { return a + (-b); }
  friend ModuloPrime operator*(const ModuloPrime& a, const ModuloPrime& b) {
    __extension__ using Wide = unsigned __int128;
    return of(static_cast<std::uint64_t>(static_cast<Wide>(a.residue_) * b.residue_ % prime));
  }
  /// a times b^(prime - 2), the inverse of b; 0 where b is 0, which no solver divides by.
  friend ModuloPrime operator/(const ModuloPrime& a, ModuloPrime b) {
    ModuloPrime result = a;
    for (std::uint64_t power = prime - 2; power > 0; power /= 2, b = b * b)
      if (power % 2 == 1) result = result * b;
    return result;
  }
  friend bool operator==(const ModuloPrime&, const ModuloPrime&) = default;
  /// That of the representatives from -(p - 1)/2 to (p - 1)/2, so that -1 is less than 0. Nothing else of it
  /// has a meaning.
  friend std::strong_ordering operator<=>(const ModuloPrime& a, const ModuloPrime& b) {
    return a.representative() <=> b.representative();
  }
  explicit operator double() const { return static_cast<double>(representative()); }
  friend std::ostream& operator<<(std::ostream& stream, const ModuloPrime& x) {
    return stream << x.residue_ << " mod 2^61 - 1";
  }

 private:
  static ModuloPrime of(std::uint64_t residue) {
    ModuloPrime x;
    x.residue_ = residue;
    return x;
  }
  static ModuloPrime of_digits(const std::string& integer) {
    ModuloPrime x;
    for (const char c : integer)
      if (c != '-') x = x * 10 + (c - '0');
    return integer.front() == '-' ? -x : x;
  }
  [[nodiscard]] std::int64_t representative() const {
    const auto residue = static_cast<std::int64_t>(residue_);
    return residue_ > prime / 2 ? residue - static_cast<std::int64_t>(prime) : residue;
  }
  std::uint64_t residue_ = 0;
};

inline ModuloPrime value_of(const ModuloPrime& x) { return x; }
/// The size by which solvers choose pivots: all numbers but 0 serve as well as each other.
inline ModuloPrime abs(const ModuloPrime& x) { return x == ModuloPrime(0) ? 0 : 1; }
inline bool isfinite(const ModuloPrime& /*x*/) { return true; }
inline bool isnan(const ModuloPrime& /*x*/) { return false; }
inline ModuloPrime select(const ModuloPrime& condition, const ModuloPrime& positive,
                          const ModuloPrime& otherwise) {
  return condition > ModuloPrime(0) ? positive : otherwise;
}

}  // namespace pfaff::testing
