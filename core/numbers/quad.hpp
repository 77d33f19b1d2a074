// Quad: IEEE binary128 arithmetic as a number type of its own.
//
// A thin value type over the compiler's __float128 (113-bit significand, unit round-off 2^-113 = 9.6e-35).
// The functions of libquadmath are declared here instead of including its header, which clang does not ship
// and which multiplies compile times. Everything is inline except sums, products, parsing and printing.
#pragma once

#include <concepts>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

#include <pfaff/core/numbers/binary128.hpp>

extern "C" {
__float128 sqrtq(__float128) noexcept;
__float128 expq(__float128) noexcept;
__float128 logq(__float128) noexcept;
__float128 sinq(__float128) noexcept;
__float128 cosq(__float128) noexcept;
void sincosq(__float128, __float128*, __float128*) noexcept;
__float128 powq(__float128, __float128) noexcept;
__float128 atanq(__float128) noexcept;
__float128 erfq(__float128) noexcept;
__float128 sinhq(__float128) noexcept;
__float128 tanhq(__float128) noexcept;
}

namespace pfaff {

/// A binary128 number.
class Quad {
 public:
  constexpr Quad() = default;
  constexpr Quad(int value) : value_(value) {}     // NOLINT(google-explicit-constructor)
  constexpr Quad(double value) : value_(value) {}  // NOLINT(google-explicit-constructor)
  constexpr explicit Quad(long value) : value_(value) {}
  constexpr explicit Quad(__float128 value) : value_(value) {}

  /// Nearest double.
  constexpr explicit operator double() const { return static_cast<double>(value_); }
  [[nodiscard]] constexpr __float128 native() const { return value_; }

  friend constexpr Quad operator-(Quad a) { return Quad(-a.value_); }
  friend constexpr Quad operator+(Quad a, Quad b) {
    return Quad(std::is_constant_evaluated() ? a.value_ + b.value_ : binary128_sum(a.value_, b.value_));
  }
  friend constexpr Quad operator-(Quad a, Quad b) { return a + -b; }
  friend constexpr Quad operator*(Quad a, Quad b) {
    return Quad(std::is_constant_evaluated() ? a.value_ * b.value_ : binary128_product(a.value_, b.value_));
  }
  friend constexpr Quad operator/(Quad a, Quad b) { return Quad(a.value_ / b.value_); }

  /// start + a[0] b[0] + a[a_step] b[b_step] + ... of `count` products, two and more rounded once, in half to
  /// two thirds of the time of as many products and sums.
  friend Quad sum_of_products(Quad start, const Quad* a, std::ptrdiff_t a_step, const Quad* b,
                              std::ptrdiff_t b_step, std::size_t count) {
    static_assert(sizeof(Quad) == sizeof(__float128));
    return Quad(binary128_sum_of_products(start.value_, &a->value_, a_step, &b->value_, b_step, count));
  }

  constexpr Quad& operator+=(Quad other) { return *this = *this + other; }
  constexpr Quad& operator-=(Quad other) { return *this = *this - other; }
  constexpr Quad& operator*=(Quad other) { return *this = *this * other; }
  constexpr Quad& operator/=(Quad other) { return *this = *this / other; }

  friend constexpr bool operator==(Quad a, Quad b) { return a.value_ == b.value_; }
  friend constexpr bool operator<(Quad a, Quad b) { return a.value_ < b.value_; }
  friend constexpr bool operator>(Quad a, Quad b) { return a.value_ > b.value_; }
  friend constexpr bool operator<=(Quad a, Quad b) { return a.value_ <= b.value_; }
  friend constexpr bool operator>=(Quad a, Quad b) { return a.value_ >= b.value_; }

 private:
  __float128 value_ = 0;
};

inline Quad sqrt(Quad x) { return Quad(sqrtq(x.native())); }
inline Quad exp(Quad x) { return Quad(expq(x.native())); }
inline Quad log(Quad x) { return Quad(logq(x.native())); }
inline Quad sin(Quad x) { return Quad(sinq(x.native())); }
inline Quad cos(Quad x) { return Quad(cosq(x.native())); }
inline Quad pow(Quad x, Quad y) { return Quad(powq(x.native(), y.native())); }
constexpr Quad abs(Quad x) { return x < Quad(0) ? -x : x; }
constexpr bool isfinite(Quad x) { return x - x == Quad(0); }
constexpr bool isnan(Quad x) { return !(x == x); }

/// The nearest Quad of a decimal string such as "-1.25e-3". The whole string must be a number.
/// Returns false and leaves `result` alone when it is not.
bool parse(std::string_view text, Quad& result);

/// Decimal text with `digits` significant digits (36 identify a Quad).
std::string to_string(Quad x, int digits = 36);
/// The same with an exponent always, "-1.25e-03"; trailing zeros are kept.
std::string to_scientific(Quad x, int digits);

}  // namespace pfaff

template <>
class std::numeric_limits<pfaff::Quad> {
 public:
  static constexpr bool is_specialized = true;
  static constexpr bool is_signed = true;
  static constexpr bool is_integer = false;
  static constexpr bool is_exact = false;
  static constexpr bool has_infinity = true;
  static constexpr bool has_quiet_NaN = true;
  static constexpr int digits = 113;
  static constexpr int digits10 = 33;
  static constexpr int max_digits10 = 36;
  static constexpr int radix = 2;
  static constexpr pfaff::Quad epsilon() { return pfaff::Quad(0x1p-112); }
  static constexpr pfaff::Quad infinity() { return pfaff::Quad(numeric_limits<double>::infinity()); }
  static constexpr pfaff::Quad quiet_NaN() { return pfaff::Quad(numeric_limits<double>::quiet_NaN()); }
};
