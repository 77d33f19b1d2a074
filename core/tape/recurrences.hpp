// The recurrences of truncated power series: coefficient l of a result from coefficients 0 .. l of its
// operands and 0 .. l-1 of its own. Sums are over i:
//
//   product a_i b_{l-i};  quotient (a_l - sum_{i>=1} b_i r_{l-i}) / b_0;  square root (a_l - r_i r_{l-i}) /
//   (2 r_0); exponential (1/l) i a_i r_{l-i};  sine and cosine coupled;  logarithm (a_l - (1/l) i r_i
//   a_{l-i}) / a_0; power a^e: (i e - (l - i)) a_i r_{l-i} / (l a_0);  a function whose derivative at a is d:
//   (1/l) i a_i d_{l-i}
//
// Authors' formulas are expanded by them (online_series.hpp), and the text of this file is a part of what
// models are compiled from (core/native/series_text.cpp): it includes nothing. SeriesReplay (series.hpp) adds
// up many lanes at once in loops of its own. P is a number or several side by side, L an int or a constant
// that converts to one. Where l >= 1 is said, coefficient 0 is a function of a number, which the caller
// knows.
#pragma once

namespace pfaff::recurrences {

#define PFAFF_RECURRENCE __attribute__((always_inline)) inline

template <class P, class L>
PFAFF_RECURRENCE P product(const P* a, const P* b, L l) {
  P sum = a[0] * b[l];
  for (int i = 1; i <= l; ++i) sum = sum + a[i] * b[l - i];
  return sum;
}
template <class P, class L>
PFAFF_RECURRENCE P square(const P* a, L l) {
  if (l == 0) return a[0] * a[0];
  P sum = a[0] * a[l];
  for (int i = 1; 2 * i < l; ++i) sum = sum + a[i] * a[l - i];
  sum = sum + sum;
  return l % 2 == 0 ? sum + a[l / 2] * a[l / 2] : sum;
}
// `dividend` is a_l.
template <class P, class L>
PFAFF_RECURRENCE P quotient(P dividend, const P* b, const P* r, L l) {
  for (int i = 1; i <= l; ++i) dividend = dividend - b[i] * r[l - i];
  return dividend / b[0];
}
// From here on l >= 1.
template <class P, class L>
PFAFF_RECURRENCE P square_root(const P* a, const P* r, L l) {
  P sum = a[l];
  for (int i = 1; i < l; ++i) sum = sum - r[i] * r[l - i];
  return sum / (2.0 * r[0]);
}
// A function of a whose derivative is `slope`, which is the function itself where it is the exponential.
// Beyond `last` the coefficients of a are zero.
template <class P, class L>
PFAFF_RECURRENCE P from_slope(const P* a, const P* slope, L l, int last) {
  P sum = a[1] * slope[l - 1];
  for (int i = 2; i <= last; ++i) sum = sum + (1.0 * i) * a[i] * slope[l - i];
  return sum * (1.0 / l);
}
template <class P, class L>
PFAFF_RECURRENCE P logarithm(const P* a, const P* r, L l) {
  P sum = P{};
  for (int i = 1; i < l; ++i) sum = sum + (1.0 * i) * r[i] * a[l - i];
  return (a[l] - sum * (1.0 / l)) / a[0];
}
// Zero where a begins with zeros that make it so (series.hpp).
template <class P, class L>
PFAFF_RECURRENCE P power(const P* a, double e, const P* r, L l) {
  if (nothing(a[0])) {
    int m = 1;
    while (m <= l && nothing(a[m])) ++m;
    if (m * e > l) return P{};
  }
  P sum = P{};
  for (int i = 1; i <= l; ++i) sum = sum + (i * e - (l - i)) * a[i] * r[l - i];
  return sum / ((1.0 * l) * a[0]);
}
template <class P, class L>
PFAFF_RECURRENCE void sine_cosine(const P* a, P* s, P* c, L l, int last) {
  P p = a[1] * c[l - 1], q = a[1] * s[l - 1];
  for (int i = 2; i <= last; ++i) {
    const P scaled = (1.0 * i) * a[i];
    p = p + scaled * c[l - i];
    q = q + scaled * s[l - i];
  }
  s[l] = p * (1.0 / l);
  c[l] = q * (-1.0 / l);
}

#undef PFAFF_RECURRENCE

}  // namespace pfaff::recurrences
