// A scalar type that lacks one of the things a scalar must provide, or, as the control, lacks nothing.
#pragma once

#include <cmath>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff::testing {

enum class lacks {
  nothing,
  integers,
  constants,
  negation,
  sum,
  difference,
  product,
  quotient,
  square_root,
  exponential,
  logarithm,
  sine,
  cosine,
  power,
  branch,
  doubles,
  value
};

template <lacks Lack>
struct Lacking {
  double x = 0;

  Lacking() = default;
  Lacking(int v) requires(Lack != lacks::integers) : x(v) {}  // NOLINT(google-explicit-constructor)
  explicit Lacking(const Real& v) requires(Lack != lacks::constants) : x(v.value()) {}
  explicit Lacking(double v) requires(Lack != lacks::doubles && Lack != lacks::integers) : x(v) {}

  static Lacking of(double v) {
    Lacking r;
    r.x = v;
    return r;
  }
  friend Lacking operator-(const Lacking& a) requires(Lack != lacks::negation) { return of(-a.x); }
  friend Lacking operator+(const Lacking& a, const Lacking& b) requires(Lack != lacks::sum) {
    return of(a.x + b.x);
  }
  friend Lacking operator-(const Lacking& a, const Lacking& b) requires(Lack != lacks::difference) {
    return of(a.x - b.x);
  }
  friend Lacking operator*(const Lacking& a, const Lacking& b) requires(Lack != lacks::product) {
    return of(a.x * b.x);
  }
  friend Lacking operator/(const Lacking& a, const Lacking& b) requires(Lack != lacks::quotient) {
    return of(a.x / b.x);
  }
  friend Lacking sqrt(const Lacking& a) requires(Lack != lacks::square_root) { return of(std::sqrt(a.x)); }
  friend Lacking exp(const Lacking& a) requires(Lack != lacks::exponential) { return of(std::exp(a.x)); }
  friend Lacking log(const Lacking& a) requires(Lack != lacks::logarithm) { return of(std::log(a.x)); }
  friend Lacking sin(const Lacking& a) requires(Lack != lacks::sine) { return of(std::sin(a.x)); }
  friend Lacking cos(const Lacking& a) requires(Lack != lacks::cosine) { return of(std::cos(a.x)); }
  friend Lacking pow(const Lacking& a, const Real& y) requires(Lack != lacks::power) {
    return of(std::pow(a.x, y.value()));
  }
  friend Lacking select(const Lacking& condition, const Lacking& positive,
                        const Lacking& otherwise) requires(Lack != lacks::branch) {
    return condition.x > 0 ? positive : otherwise;
  }
  friend Lacking value_of(const Lacking& a) requires(Lack != lacks::value) { return a; }
  friend bool isfinite(const Lacking& a) { return std::isfinite(a.x); }
};

}  // namespace pfaff::testing
