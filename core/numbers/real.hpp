// Real: an exact decimal or rational constant, before it takes a precision.
//
// Parameters and literals of a formula are Reals. A Real converts to every scalar with one rounding, so that
// `0.3_r` is 3/10 to the last bit in double and in quad, and stays the exact fraction 3/10 for scalars that
// can hold it (rationals, the recording scalar). Products such as `nu * x` take the scalar of x.
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// A constant known exactly (as a fraction of 64-bit integers) or to quad precision.
class Real {
 public:
  constexpr Real() = default;
  constexpr Real(int value)  // NOLINT(google-explicit-constructor)
      : rounded_(value), quad_(value), numerator_(value), denominator_(1) {}
  /// A fraction; `denominator` > 0.
  static Real fraction(std::int64_t numerator, std::int64_t denominator);
  /// A constant known to quad precision only.
  explicit constexpr Real(Quad value) : rounded_(static_cast<double>(value)), quad_(value), denominator_(0) {}
  /// A double is not the decimal it was written as (and would be cut to an int): use 0.3_r, or Real(Quad(x))
  /// for the binary number itself.
  template <std::floating_point F>
  Real(F value) = delete;  // expected a literal such as 0.3_r, or Real(Quad(x))

  /// Parses "0.1", "-2.5e-3" or "a/b"; nullopt when the text is not a number.
  static std::optional<Real> parse(std::string_view text);

  constexpr explicit operator double() const { return rounded_; }
  constexpr explicit operator Quad() const { return quad_; }
  [[nodiscard]] constexpr double value() const { return rounded_; }
  [[nodiscard]] constexpr Quad quad() const { return quad_; }

  /// True where the constant is exactly numerator()/denominator().
  [[nodiscard]] constexpr bool is_fraction() const { return denominator_ != 0; }
  [[nodiscard]] constexpr std::int64_t numerator() const { return numerator_; }
  [[nodiscard]] constexpr std::int64_t denominator() const { return denominator_; }

  /// Exact comparison with an integer (used for folding 0 and 1 when formulas are recorded).
  [[nodiscard]] constexpr bool is(int value) const { return quad_ == Quad(value); }

  friend Real operator-(const Real& a);
  friend Real operator+(const Real& a, const Real& b);
  friend Real operator-(const Real& a, const Real& b);
  friend Real operator*(const Real& a, const Real& b);
  friend Real operator/(const Real& a, const Real& b);
  friend constexpr bool operator==(const Real& a, const Real& b) { return a.quad_ == b.quad_; }
  friend constexpr bool operator<(const Real& a, const Real& b) { return a.quad_ < b.quad_; }
  friend constexpr bool operator>(const Real& a, const Real& b) { return a.quad_ > b.quad_; }

 private:
  double rounded_ = 0;
  Quad quad_{0};
  std::int64_t numerator_ = 0;
  std::int64_t denominator_ = 1;        // 0: not a fraction of 64-bit integers
  __extension__ typedef __int128 Wide;  // NOLINT(modernize-use-using): only a typedef takes __extension__
  static Real fold(const Real& a, const Real& b, Quad value, Wide numerator, Wide denominator);
};

Real sqrt(const Real& x);
Real exp(const Real& x);
Real log(const Real& x);
Real sin(const Real& x);
Real cos(const Real& x);
Real pow(const Real& x, const Real& y);

/// Shortest text that names the constant, as a person writes it: "10", "0.3", "1e-12", "1/3"; up to 36
/// digits.
std::string to_string(const Real& x);

inline namespace literals {
/// 0.3_r: a decimal literal, exact in every scalar. Ill-formed text cannot occur (the compiler has parsed
/// it).
Real operator""_r(const char* text);
}  // namespace literals

/// A type that constants convert to. What a scalar owes beside that: core/numbers/formula_scalar.hpp.
template <class T>
concept MixesWithReal =
    !std::is_integral_v<std::remove_cvref_t<T>> && !std::same_as<std::remove_cvref_t<T>, Real> &&
    std::constructible_from<T, const Real&>;

template <MixesWithReal T>
T operator+(const Real& a, const T& b) {
  return T(a) + b;
}
template <MixesWithReal T>
T operator-(const Real& a, const T& b) {
  return T(a) - b;
}
template <MixesWithReal T>
T operator*(const Real& a, const T& b) {
  return T(a) * b;
}
template <MixesWithReal T>
T operator/(const Real& a, const T& b) {
  return T(a) / b;
}
template <MixesWithReal T>
T operator+(const T& a, const Real& b) {
  return a + T(b);
}
template <MixesWithReal T>
T operator-(const T& a, const Real& b) {
  return a - T(b);
}
template <MixesWithReal T>
T operator*(const T& a, const Real& b) {
  return a * T(b);
}
template <MixesWithReal T>
T operator/(const T& a, const Real& b) {
  return a / T(b);
}

}  // namespace pfaff

// Every plug-in holds such vectors: they are compiled once.
extern template class std::vector<pfaff::Real>;
