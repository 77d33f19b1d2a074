// Numbers of twice the digits: the sum of a rounded number and of what its rounding has left (dekker1971).
//
// For the few places where a difference of large numbers is asked for to its own last digit. Each operation
// is wrong by some u^2 of its result, u being the unit round-off of V. V is double or Quad.
#pragma once

#include <cmath>
#include <type_traits>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/core/numbers/sum_of_two.hpp>

namespace pfaff {

/// high + low, with |low| <= u |high|.
template <class V>
struct TwoTerms {
  V high{0}, low{0};

  TwoTerms() = default;
  TwoTerms(const V& value) : high(value) {}  // NOLINT(google-explicit-constructor)
  /// a + b for |b| <= |a| or so.
  TwoTerms(const V& a, const V& b) { two_sum(a, b, high, low); }

  /// a b, exactly.
  static TwoTerms product(const V& a, const V& b) {
    TwoTerms r(a * b);
    if constexpr (std::is_same_v<V, double>) {
      r.low = std::fma(a, b, -r.high);
    } else {
      const auto [a1, a2] = halves(a);
      const auto [b1, b2] = halves(b);
      r.low = ((a1 * b1 - r.high) + a1 * b2 + a2 * b1) + a2 * b2;
    }
    return r;
  }
  static TwoTerms pi() {
    static const Quad quad = (3.14159265358979323846264338327950288_r).quad();
    if constexpr (std::is_same_v<V, double>) return {V(quad), V(quad - Quad(static_cast<double>(quad)))};
    return {V(quad), V((8.67181013012378102479704402604335197e-35_r).quad())};
  }

  friend TwoTerms operator-(const TwoTerms& a) {
    TwoTerms r;
    r.high = -a.high;
    r.low = -a.low;
    return r;
  }
  friend TwoTerms operator+(const TwoTerms& a, const TwoTerms& b) {
    const TwoTerms sum(a.high, b.high), rest(a.low, b.low);
    const TwoTerms middle(sum.high, sum.low + rest.high);
    return {middle.high, middle.low + rest.low};
  }
  friend TwoTerms operator-(const TwoTerms& a, const TwoTerms& b) { return a + -b; }
  friend TwoTerms operator*(const TwoTerms& a, const TwoTerms& b) {
    const TwoTerms whole = product(a.high, b.high);
    return {whole.high, whole.low + (a.high * b.low + a.low * b.high)};
  }
  friend TwoTerms operator/(const TwoTerms& a, const TwoTerms& b) {
    const V first = a.high / b.high;
    const TwoTerms rest = a - b * TwoTerms(first);
    return {first, rest.high / b.high};
  }
  friend TwoTerms sqrt(const TwoTerms& a) {
    const V root = sqrt(a.high);
    const TwoTerms rest = a - product(root, root);
    return {root, rest.high / (V(2) * root)};
  }

 private:
  struct Halves {
    V first, second;
  };
  // x as a sum of two numbers of half the digits (Veltkamp, in dekker1971), for a quad of 113.
  static Halves halves(const V& x) {
    static const V splitter = V(0x1p57) + V(1);
    const V scaled = splitter * x, first = scaled - (scaled - x);
    return {first, x - first};
  }
};

}  // namespace pfaff
