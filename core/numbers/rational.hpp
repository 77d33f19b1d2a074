// Rational: exact fractions of integers of any length, for identities that must hold to the last digit.
//
// A scalar like the others as far as + - * / and comparisons go; roots and transcendental functions do not
// exist. It costs a heavy header, memory and, as numerators grow, time, so that it has no place inside a
// step.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <compare>
#include <concepts>
#include <cstdint>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {
class Rational;
}

template <>
class std::numeric_limits<pfaff::Rational> {
 public:
  static constexpr bool is_specialized = true;
  static constexpr bool is_signed = true;
  static constexpr bool is_integer = false;
  static constexpr bool is_exact = true;
  static constexpr bool has_infinity = false;
  static constexpr bool has_quiet_NaN = false;
  static constexpr int radix = 2;
  static pfaff::Rational epsilon();  // 0
};

namespace pfaff {

/// A fraction in lowest terms. Dividing by zero throws std::overflow_error.
class Rational {
 public:
  using Number = boost::multiprecision::number<boost::multiprecision::cpp_rational_backend,
                                               boost::multiprecision::et_off>;

  Rational() = default;
  Rational(int value) : value_(value) {}  // NOLINT(google-explicit-constructor)
  /// The exact constant; throws std::domain_error for one that is known to quad precision only.
  explicit Rational(const Real& x) {
    if (!x.is_fraction()) throw std::domain_error(to_string(x) + " is rounded, so no exact fraction");
    value_ = Number(x.numerator()) / Number(x.denominator());
  }
  /// The binary number itself, not the decimal it was written as; throws std::domain_error unless finite.
  explicit Rational(double x) : value_(isfinite(x) ? x : not_finite()) {}
  explicit Rational(Quad x) {
    if (!isfinite(x)) not_finite();
    while (x != Quad(0)) {
      const auto part = static_cast<double>(x);
      if (!isfinite(part) || part == 0)
        throw std::domain_error("a number beyond the range of double is not made exact");
      value_ += Number(part);
      x -= Quad(part);
    }
  }

  explicit operator double() const { return value_.convert_to<double>(); }
// GCC's 12th version takes limbs of Boost's temporary for uninitialised where all of this is inlined.
#ifndef __clang__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
  explicit operator Quad() const {
    Quad sum(0);
    Number rest = value_;
    for (int part = 0; part < 4; ++part) {
      const auto nearest = rest.convert_to<double>();
      sum += Quad(nearest);
      rest -= nearest;
    }
    return sum;
  }
#ifndef __clang__
#pragma GCC diagnostic pop
#endif
  [[nodiscard]] const Number& number() const { return value_; }

  Rational& operator+=(const Rational& o) { return *this = *this + o; }
  Rational& operator-=(const Rational& o) { return *this = *this - o; }
  Rational& operator*=(const Rational& o) { return *this = *this * o; }
  Rational& operator/=(const Rational& o) { return *this = *this / o; }
  friend Rational operator-(const Rational& a) { return Rational(Number(-a.value_)); }
  friend Rational operator+(const Rational& a, const Rational& b) {
    return Rational(Number(a.value_ + b.value_));
  }
  friend Rational operator-(const Rational& a, const Rational& b) {
    return Rational(Number(a.value_ - b.value_));
  }
  friend Rational operator*(const Rational& a, const Rational& b) {
    return Rational(Number(a.value_ * b.value_));
  }
  friend Rational operator/(const Rational& a, const Rational& b) {
    return Rational(Number(a.value_ / b.value_));
  }
  friend bool operator==(const Rational& a, const Rational& b) { return a.value_ == b.value_; }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
    return a.value_.compare(b.value_) <=> 0;
  }

 private:
  template <std::same_as<Number> N>
  explicit Rational(N value) : value_(std::move(value)) {}
  [[noreturn]] static double not_finite() { throw std::domain_error("only finite numbers are fractions"); }
  Number value_;
};

inline Rational value_of(const Rational& x) { return x; }
inline Rational abs(const Rational& x) { return x < Rational(0) ? -x : x; }
inline bool isfinite(const Rational& /*x*/) { return true; }
inline bool isnan(const Rational& /*x*/) { return false; }
inline Rational select(const Rational& condition, const Rational& positive, const Rational& otherwise) {
  return condition > Rational(0) ? positive : otherwise;
}
/// x^y for an integer y; throws std::domain_error for any other.
inline Rational pow(const Rational& x, const Real& y) {
  if (!y.is_fraction() || y.denominator() != 1)
    throw std::domain_error("x^(" + to_string(y) + ") is no fraction");
  const Rational base = y.numerator() < 0 ? Rational(1) / x : x;
  Rational power(1);
  for (std::int64_t k = y.numerator() < 0 ? -y.numerator() : y.numerator(); k > 0; --k) power = power * base;
  return power;
}
/// "-3/4", "5".
inline std::string to_string(const Rational& x) { return x.number().str(); }
inline std::ostream& operator<<(std::ostream& stream, const Rational& x) { return stream << to_string(x); }

}  // namespace pfaff

inline pfaff::Rational std::numeric_limits<pfaff::Rational>::epsilon() { return 0; }
