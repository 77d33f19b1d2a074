// Dual numbers: a value and N directional derivatives, propagated together (forward differentiation).
//
// Fixed N, std::array inside, 32-byte aligned for doubles so that the derivative loops vectorise. Nest as
// Dual<Dual<T, N>, N> for second derivatives. Functions are exact to round-off for value and derivatives
// alike.
#pragma once

#include <array>
#include <cstddef>

#include <pfaff/core/numbers/special.hpp>

namespace pfaff {

/// value + sum_k derivative[k] eps_k with eps_j eps_k = 0.
template <class T, int N>
struct alignas(std::is_same_v<T, double> ? 32 : alignof(T)) Dual {
  std::array<T, N> derivative{};
  T value{};

  Dual() = default;
  Dual(int v) : value(v) {}       // NOLINT(google-explicit-constructor)
  Dual(const T& v) : value(v) {}  // NOLINT(google-explicit-constructor)
  explicit Dual(const Real& v) : value(T(v)) {}
  Dual(double v) requires(!std::is_same_v<T, double>)  // NOLINT(google-explicit-constructor)
      : value(v) {}

  /// The variable in direction k: derivative 1 there, 0 elsewhere.
  static Dual variable(const T& v, int k) {
    Dual x(v);
    x.derivative[static_cast<std::size_t>(k)] = T(1);
    return x;
  }

  Dual& operator+=(const Dual& o) { return *this = *this + o; }
  Dual& operator-=(const Dual& o) { return *this = *this - o; }
  Dual& operator*=(const Dual& o) { return *this = *this * o; }
  Dual& operator/=(const Dual& o) { return *this = *this / o; }

  friend Dual operator-(const Dual& a) {
    Dual r(-a.value);
    for (std::size_t k = 0; k < N; ++k) r.derivative[k] = -a.derivative[k];
    return r;
  }
  friend Dual operator+(const Dual& a, const Dual& b) {
    Dual r(a.value + b.value);
    for (std::size_t k = 0; k < N; ++k) r.derivative[k] = a.derivative[k] + b.derivative[k];
    return r;
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    Dual r(a.value - b.value);
    for (std::size_t k = 0; k < N; ++k) r.derivative[k] = a.derivative[k] - b.derivative[k];
    return r;
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    Dual r(a.value * b.value);
    for (std::size_t k = 0; k < N; ++k)
      r.derivative[k] = a.derivative[k] * b.value + a.value * b.derivative[k];
    return r;
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    Dual r(a.value / b.value);
    for (std::size_t k = 0; k < N; ++k)
      r.derivative[k] = (a.derivative[k] - r.value * b.derivative[k]) / b.value;
    return r;
  }
};

template <class T, int N>
struct ValueOf<Dual<T, N>> {
  using type = Value<T>;
};
template <class T, int N>
Value<T> value_of(const Dual<T, N>& x) {
  return value_of(x.value);
}

template <class T, int N>
inline constexpr int derivative_depth<Dual<T, N>> = 1 + derivative_depth<T>;

/// f(x) with f and f' at the value given: the chain rule.
template <class T, int N>
Dual<T, N> chain(const Dual<T, N>& x, const T& f, const T& slope) {
  Dual<T, N> r(f);
  for (std::size_t k = 0; k < N; ++k) r.derivative[k] = slope * x.derivative[k];
  return r;
}

template <class T, int N>
Dual<T, N> sqrt(const Dual<T, N>& x) {
  const T root = sqrt(x.value);
  return chain(x, root, T(1) / (T(2) * root));
}
template <class T, int N>
Dual<T, N> exp(const Dual<T, N>& x) {
  const T e = exp(x.value);
  return chain(x, e, e);
}
template <class T, int N>
Dual<T, N> log(const Dual<T, N>& x) {
  return chain(x, T(log(x.value)), T(1) / x.value);
}
template <class T, int N>
Dual<T, N> sin(const Dual<T, N>& x) {
  T s, c;
  sine_cosine(x.value, s, c);
  return chain(x, s, c);
}
template <class T, int N>
Dual<T, N> cos(const Dual<T, N>& x) {
  T s, c;
  sine_cosine(x.value, s, c);
  return chain(x, c, T(-s));
}
/// x^y for a constant exponent.
template <class T, int N>
Dual<T, N> pow(const Dual<T, N>& x, const Real& y) {
  // The exponent stays a Real on the way down: a nested dual would go through the logarithm otherwise, which
  // negative bases do not have.
  if (y.is(0)) return chain(x, T(1), T(0));
  return chain(x, T(pow(x.value, y)), T(T(y) * pow(x.value, y - Real(1))));
}
template <class T, int N>
Dual<T, N> pow(const Dual<T, N>& x, const Dual<T, N>& y) {
  return exp(y * log(x));
}

template <class T, int N>
Dual<T, N> special(SpecialFunction which, const Dual<T, N>& x, const Dual<T, N>& slope) {
  return chain(x, T(special(which, x.value, slope.value)), slope.value);
}

template <class T, int N>
Dual<T, N> select(const Dual<T, N>& condition, const Dual<T, N>& positive, const Dual<T, N>& otherwise) {
  Dual<T, N> r(select(condition.value, positive.value, otherwise.value));
  for (std::size_t k = 0; k < N; ++k)
    r.derivative[k] = select(condition.value, positive.derivative[k], otherwise.derivative[k]);
  return r;
}

}  // namespace pfaff
