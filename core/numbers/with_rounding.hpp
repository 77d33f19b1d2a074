// WithRounding: a number and a bound of the rounding errors that have gone into it.
//
// It tells a result that differs from zero from one that is only the round-off of its terms, whatever its
// unit. A formula replayed with this scalar gives its results together with bounds of their errors, to first
// order (running error analysis).
#pragma once

#include <cmath>

#include <pfaff/core/numbers/special.hpp>

namespace pfaff {

/// A value of type T (double, Quad) whose error is at most `error` units of round-off.
template <class T>
struct WithRounding {
  T value{};
  T error{};  // in units of unit_roundoff<T>()

  WithRounding() = default;
  WithRounding(int v) : value(v) {}       // NOLINT(google-explicit-constructor)
  WithRounding(const T& v) : value(v) {}  // NOLINT(google-explicit-constructor)
  WithRounding(const T& v, const T& e) : value(v), error(e) {}
  /// A constant, rounded unless it is an integer.
  explicit WithRounding(const Real& v)
      : value(T(v)), error(v.is_fraction() && v.denominator() == 1 ? T(0) : T(abs(value))) {}
  WithRounding(double v) requires(!std::is_same_v<T, double>)  // NOLINT(google-explicit-constructor)
      : value(v) {}

  /// Larger than its error bound.
  [[nodiscard]] bool significant() const { return abs(value) > unit_roundoff<T>() * error; }

  friend WithRounding operator-(const WithRounding& a) { return {T(-a.value), a.error}; }
  friend WithRounding operator+(const WithRounding& a, const WithRounding& b) {
    const T v = a.value + b.value;
    return {v, a.error + b.error + T(abs(v))};
  }
  friend WithRounding operator-(const WithRounding& a, const WithRounding& b) {
    const T v = a.value - b.value;
    return {v, a.error + b.error + T(abs(v))};
  }
  friend WithRounding operator*(const WithRounding& a, const WithRounding& b) {
    const T v = a.value * b.value;
    return {v, T(abs(a.value)) * b.error + T(abs(b.value)) * a.error + T(abs(v))};
  }
  friend WithRounding operator/(const WithRounding& a, const WithRounding& b) {
    const T v = a.value / b.value;
    return {v, (a.error + T(abs(v)) * b.error) / T(abs(b.value)) + T(abs(v))};
  }
};

template <class T>
struct ValueOf<WithRounding<T>> {
  using type = T;
};
template <class T>
T value_of(const WithRounding<T>& x) {
  return x.value;
}

/// f(x), where `slope` is f'(x) up to its sign: the error of the argument times the slope, and one rounding
/// of the result.
template <class T>
WithRounding<T> rounded(const WithRounding<T>& x, const T& f, const T& slope) {
  return {f, T(abs(slope)) * x.error + T(abs(f))};
}
template <class T>
WithRounding<T> sqrt(const WithRounding<T>& x) {
  const T root = sqrt(x.value);
  return rounded(x, root, T(T(1) / (T(2) * root)));
}
template <class T>
WithRounding<T> exp(const WithRounding<T>& x) {
  const T e = exp(x.value);
  return rounded(x, e, e);
}
template <class T>
WithRounding<T> log(const WithRounding<T>& x) {
  return rounded(x, T(log(x.value)), T(T(1) / x.value));
}
template <class T>
WithRounding<T> sin(const WithRounding<T>& x) {
  return rounded(x, T(sin(x.value)), T(cos(x.value)));
}
template <class T>
WithRounding<T> cos(const WithRounding<T>& x) {
  return rounded(x, T(cos(x.value)), T(sin(x.value)));
}
/// x^y for a constant exponent.
template <class T>
WithRounding<T> pow(const WithRounding<T>& x, const Real& y) {
  return rounded(x, T(pow(x.value, y)), T(T(y) * pow(x.value, y - Real(1))));
}
template <class T>
WithRounding<T> special(SpecialFunction which, const WithRounding<T>& x, const WithRounding<T>& slope) {
  return rounded(x, T(special(which, x.value, slope.value)), slope.value);
}
template <class T>
WithRounding<T> select(const WithRounding<T>& condition, const WithRounding<T>& positive,
                       const WithRounding<T>& otherwise) {
  return condition.value > T(0) ? positive : otherwise;
}

}  // namespace pfaff
