// Functions beyond those that every scalar brings: special functions, whose derivative is a formula of its
// own, and what is made of these, of exponentials and of branches.
//
// Formulas call them by their usual names: abs, sign, min, max, sinh, cosh, tanh, atan, asin, acos, atan2,
// erf. A scalar owes one function for all special ones, special(which, x, slope), where slope is the
// derivative at x in the same scalar: its derivatives, its rounding and its series follow from the slope by
// one rule for all.
#pragma once

#include <concepts>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

enum class SpecialFunction { arctangent, error_function, hyperbolic_sine, hyperbolic_tangent };

inline double special(SpecialFunction which, double x, double /*slope*/) {
  switch (which) {
    case SpecialFunction::arctangent:
      return std::atan(x);
    case SpecialFunction::error_function:
      return std::erf(x);
    case SpecialFunction::hyperbolic_sine:
      return std::sinh(x);
    case SpecialFunction::hyperbolic_tangent:
      break;
  }
  return std::tanh(x);
}
inline Quad special(SpecialFunction which, Quad x, Quad /*slope*/) {
  switch (which) {
    case SpecialFunction::arctangent:
      return Quad(atanq(x.native()));
    case SpecialFunction::error_function:
      return Quad(erfq(x.native()));
    case SpecialFunction::hyperbolic_sine:
      return Quad(sinhq(x.native()));
    case SpecialFunction::hyperbolic_tangent:
      break;
  }
  return Quad(tanhq(x.native()));
}

using std::acos;
using std::asin;
using std::atan;
using std::atan2;
using std::cosh;
using std::erf;
using std::sinh;
using std::tanh;

/// What formulas are evaluated with beside doubles, for which the standard library has these functions.
template <class T>
concept BeyondDouble = !std::floating_point<T> && !std::integral<T>;

/// The size of x. At x = 0 derivatives are those of -x.
template <BeyondDouble T>
T abs(const T& x) requires(!requires(const T& y, const T& z) { y < z; }) {
  return select(x, x, -x);
}
/// 1, 0 or -1 as x is above, at or below zero; derivatives are zero.
template <class T>
T sign(const T& x) {
  return select(x, T(1), select(-x, T(-1), T(0)));
}
/// The smaller and the larger of two numbers. Where they are equal derivatives are those of y.
template <class T>
T min(const T& x, const T& y) requires(requires { select(x, x, y); }) {
  return select(y - x, x, y);
}
template <class T>
T max(const T& x, const T& y) requires(requires { select(x, x, y); }) {
  return select(x - y, x, y);
}

/// By exponentials, of which the odd hyperbolic functions would lose their digits near zero.
template <BeyondDouble T>
T cosh(const T& x) {
  const T e = exp(x);
  return (e + T(1) / e) / T(2);
}
template <BeyondDouble T>
T sinh(const T& x) {
  return special(SpecialFunction::hyperbolic_sine, x, cosh(x));
}
/// The slope is (1 - tanh x) (1 + tanh x).
template <BeyondDouble T>
T tanh(const T& x) {
  const T below = T(2) / (exp(T(2) * x) + T(1));
  return special(SpecialFunction::hyperbolic_tangent, x, below * (T(2) - below));
}

template <BeyondDouble T>
T atan(const T& x) {
  return special(SpecialFunction::arctangent, x, T(1) / (T(1) + x * x));
}
/// Derivatives are infinite at x = -1 and 1.
template <BeyondDouble T>
T asin(const T& x) {
  return atan(x / sqrt((T(1) - x) * (T(1) + x)));
}
template <BeyondDouble T>
T acos(const T& x) {
  return T(2) * atan(sqrt((T(1) - x) / (T(1) + x)));
}
/// The angle of the point (x, y), between -pi and pi; no number at the origin. It is that of the ratio of the
/// smaller coordinate to the larger one, with derivatives everywhere else.
template <BeyondDouble T>
T atan2(const T& y, const T& x) {
  static const Real pi = *Real::parse("3.1415926535897932384626433832795028841971693993751058209749");
  const T flat = select(x, x, -x) - select(y, y, -y), up = select(-y, T(-1), T(1));
  return select(flat, select(-x, up * T(pi), T(0)), up * T(pi / 2)) + atan(select(flat, y / x, -x / y));
}
template <BeyondDouble T>
T erf(const T& x) {
  static const Real two_over_root_of_pi =
      *Real::parse("1.1283791670955125738961589031215451716881012586579977136882");
  return special(SpecialFunction::error_function, x, T(two_over_root_of_pi) * exp(-(x * x)));
}

}  // namespace pfaff
