#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include <pfaff/core/numbers/rational.hpp>

namespace pfaff {
namespace {

using Fraction =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

[[noreturn]] void not_finite() { throw std::domain_error("only finite numbers are fractions"); }

Fraction fraction(const Real& x) {
  if (!x.is_fraction()) throw std::domain_error(to_string(x) + " is rounded, so no exact fraction");
  return Fraction(x.numerator()) / Fraction(x.denominator());
}
Fraction fraction(double x) {
  if (!isfinite(x)) not_finite();
  return Fraction(x);
}
Fraction fraction(Quad x) {
  if (!isfinite(x)) not_finite();
  Fraction sum;
  while (x != Quad(0)) {
    const auto part = static_cast<double>(x);
    if (!isfinite(part) || part == 0)
      throw std::domain_error("a number beyond the range of double is not made exact");
    sum += Fraction(part);
    x -= Quad(part);
  }
  return sum;
}

}  // namespace

struct Rational::Number {
  Fraction value;
};

Rational::Rational() : Rational(Number()) {}
Rational::Rational(int value) : Rational(Number{Fraction(value)}) {}
Rational::Rational(const Real& x) : Rational(Number{fraction(x)}) {}
Rational::Rational(double x) : Rational(Number{fraction(x)}) {}
Rational::Rational(Quad x) : Rational(Number{fraction(x)}) {}
Rational::Rational(Number number) : number_(std::make_unique<Number>(std::move(number))) {}
Rational::Rational(const Rational& other) : Rational(*other.number_) {}
Rational::Rational(Rational&& other) noexcept = default;
Rational& Rational::operator=(const Rational& other) { return *this = Rational(other); }
Rational& Rational::operator=(Rational&& other) noexcept = default;
Rational::~Rational() = default;

Rational::operator double() const { return number_->value.convert_to<double>(); }
// GCC's 12th version takes limbs of Boost's temporary for uninitialised where all of this is inlined.
#ifndef __clang__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
Rational::operator Quad() const {
  Quad sum(0);
  Fraction rest = number_->value;
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

Rational operator-(const Rational& a) { return Rational(Rational::Number{-a.number_->value}); }
Rational operator+(const Rational& a, const Rational& b) {
  return Rational(Rational::Number{a.number_->value + b.number_->value});
}
Rational operator-(const Rational& a, const Rational& b) {
  return Rational(Rational::Number{a.number_->value - b.number_->value});
}
Rational operator*(const Rational& a, const Rational& b) {
  return Rational(Rational::Number{a.number_->value * b.number_->value});
}
Rational operator/(const Rational& a, const Rational& b) {
  return Rational(Rational::Number{a.number_->value / b.number_->value});
}
bool operator==(const Rational& a, const Rational& b) { return a.number_->value == b.number_->value; }
std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  return a.number_->value.compare(b.number_->value) <=> 0;
}
std::string to_string(const Rational& x) { return x.number_->value.str(); }

Rational pow(const Rational& x, const Real& y) {
  if (!y.is_fraction() || y.denominator() != 1)
    throw std::domain_error("x^(" + to_string(y) + ") is no fraction");
  const Rational base = y.numerator() < 0 ? Rational(1) / x : x;
  Rational power(1);
  for (std::int64_t k = y.numerator() < 0 ? -y.numerator() : y.numerator(); k > 0; --k) power = power * base;
  return power;
}

}  // namespace pfaff
