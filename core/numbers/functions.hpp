// What every formula may use: the argument types In and Out, elementary functions, select, structural zeros.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include <pfaff/core/numbers/checked_span.hpp>
#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

class Recorded;

/// The spans of formulas over T: plain ones, but for the recording scalar, which is not in a hurry.
template <class T>
struct FormulaSpans {
  using In = std::span<const T>;
  using Out = std::span<T>;
};
template <>
struct FormulaSpans<Recorded> {
  using In = CheckedSpan<const Recorded>;
  using Out = CheckedSpan<Recorded>;
};

/// A read-only vector argument of a formula. T is deduced from another argument or given.
template <class T>
using In = typename FormulaSpans<T>::In;
/// A vector that a formula fills.
template <class T>
using Out = typename FormulaSpans<T>::Out;

// The standard functions for double; every other scalar brings its own, found by argument-dependent lookup.
using std::abs;
using std::cos;
using std::exp;
using std::isfinite;
using std::isnan;
using std::log;
using std::pow;
using std::sin;
using std::sqrt;

/// True for the exponents n/2 with odd n that are taken by products and a root.
inline bool is_small_half_integer(const Real& y) {
  return y.is_fraction() && y.denominator() == 2 && y.numerator() <= 32 && y.numerator() >= -32;
}
/// x^(n/2) for odd n. Emitted code has the same (core/emit/cpp_function.cpp).
template <class T>
T half_power(const T& x, int n) {
  T result = sqrt(x), square = x;
  for (int whole = (n < 0 ? -n : n) / 2; whole > 0; whole /= 2) {
    if (whole % 2 == 1) result = result * square;
    if (whole > 1) square = square * square;
  }
  return n < 0 ? T(1) / result : result;
}

/// x^y for a constant exponent; the form every scalar offers.
inline double pow(double x, const Real& y) {
  return is_small_half_integer(y) ? half_power(x, static_cast<int>(y.numerator())) : std::pow(x, y.value());
}
inline Quad pow(Quad x, const Real& y) {
  return is_small_half_integer(y) ? half_power(x, static_cast<int>(y.numerator())) : pow(x, y.quad());
}

/// The branch of a formula: `positive` where condition > 0, `otherwise` elsewhere (both are evaluated).
inline double select(double condition, double positive, double otherwise) {
  return condition > 0 ? positive : otherwise;
}
inline Quad select(Quad condition, Quad positive, Quad otherwise) {
  return condition > Quad(0) ? positive : otherwise;
}

/// True only for a scalar that is zero by construction; lets a formula skip work. False for plain numbers.
template <class T>
constexpr bool structurally_zero(const T& /*x*/) {
  return false;
}

/// Sine and cosine of one argument.
template <class T>
void sine_cosine(const T& x, T& sine, T& cosine) {
  sine = sin(x);
  cosine = cos(x);
}
inline void sine_cosine(const Quad& x, Quad& sine, Quad& cosine) {
  __float128 s = 0, c = 0;
  sincosq(x.native(), &s, &c);
  sine = Quad(s);
  cosine = Quad(c);
}

/// The number type under a scalar: T itself for plain numbers, the type of the value for duals.
template <class T>
struct ValueOf {
  using type = T;
};
template <class T>
using Value = typename ValueOf<T>::type;

/// The highest derivative that a scalar carries along: 0 for plain numbers.
template <class T>
inline constexpr int derivative_depth = 0;

/// The number under a scalar, derivatives dropped.
inline double value_of(double x) { return x; }
inline Quad value_of(Quad x) { return x; }

/// Unit round-off of a scalar's numbers: 2^-53 in double, 2^-113 in quad.
template <class T>
constexpr Value<T> unit_roundoff() {
  return std::numeric_limits<Value<T>>::epsilon() / Value<T>(2);
}

}  // namespace pfaff
