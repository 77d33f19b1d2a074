// Rational: exact fractions of integers of any length, for identities that must hold to the last digit.
//
// A scalar like the others as far as + - * / and comparisons go; roots and transcendental functions do not
// exist. It costs memory and, as numerators grow, time, so that it has no place inside a step. The integers
// are Boost's, whose header takes seconds to compile in every source that uses it: rational.cpp alone
// includes it.
#pragma once

#include <compare>
#include <limits>
#include <memory>
#include <ostream>
#include <string>

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
  Rational();
  Rational(int value);  // NOLINT(google-explicit-constructor)
  /// The exact constant; throws std::domain_error for one that is known to quad precision only.
  explicit Rational(const Real& x);
  /// The binary number itself, not the decimal it was written as; throws std::domain_error unless finite.
  explicit Rational(double x);
  explicit Rational(Quad x);
  Rational(const Rational& other);
  Rational(Rational&& other) noexcept;
  Rational& operator=(const Rational& other);
  Rational& operator=(Rational&& other) noexcept;
  ~Rational();

  explicit operator double() const;
  explicit operator Quad() const;

  Rational& operator+=(const Rational& o) { return *this = *this + o; }
  Rational& operator-=(const Rational& o) { return *this = *this - o; }
  Rational& operator*=(const Rational& o) { return *this = *this * o; }
  Rational& operator/=(const Rational& o) { return *this = *this / o; }
  friend Rational operator-(const Rational& a);
  friend Rational operator+(const Rational& a, const Rational& b);
  friend Rational operator-(const Rational& a, const Rational& b);
  friend Rational operator*(const Rational& a, const Rational& b);
  friend Rational operator/(const Rational& a, const Rational& b);
  friend bool operator==(const Rational& a, const Rational& b);
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);
  /// "-3/4", "5".
  friend std::string to_string(const Rational& x);

 private:
  struct Number;
  explicit Rational(Number number);
  std::unique_ptr<Number> number_;
};

inline Rational value_of(const Rational& x) { return x; }
inline Rational abs(const Rational& x) { return x < Rational(0) ? -x : x; }
inline bool isfinite(const Rational& /*x*/) { return true; }
inline bool isnan(const Rational& /*x*/) { return false; }
inline Rational select(const Rational& condition, const Rational& positive, const Rational& otherwise) {
  return condition > Rational(0) ? positive : otherwise;
}
/// x^y for an integer y; throws std::domain_error for any other.
Rational pow(const Rational& x, const Real& y);
inline std::ostream& operator<<(std::ostream& stream, const Rational& x) { return stream << to_string(x); }

}  // namespace pfaff

inline pfaff::Rational std::numeric_limits<pfaff::Rational>::epsilon() { return 0; }
