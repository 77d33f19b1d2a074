// Nguyen & Turski, (3.20) and (3.21) as printed: the expansion of Jacobi's sum for the Dirac bracket of two
// constraints, with polynomials, whose brackets are polynomials again.
#pragma once

#include <pfaff/papers/printed/polynomial.hpp>

namespace pfaff::printed {

/// P_ij of a bracket {f, g} = P_ij f_i g_j.
using PolynomialTensor = std::vector<std::vector<Polynomial>>;

inline Polynomial bracket(const PolynomialTensor& p, const Polynomial& f, const Polynomial& g) {
  Polynomial sum;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < p.size(); ++j) sum = sum + p[i][j] * f.slope(i) * g.slope(j);
  return sum;
}

/// The right side of (3.21) at z.
inline Rational jacobi_expansion(const PolynomialTensor& p, const std::vector<Polynomial>& functions,
                                 const std::vector<Polynomial>& constraints, const std::vector<Rational>& z) {
  const Polynomial &f = functions[0], &g = functions[1], &h = functions[2];
  const auto b = [&](const Polynomial& left, const Polynomial& right) { return bracket(p, left, right); };
  std::vector<Polynomial> as, bs, cs;  // A_i, B_i, C_i
  for (const Polynomial& phi : constraints) {
    as.push_back(b(f, phi));
    bs.push_back(b(g, phi));
    cs.push_back(b(h, phi));
  }
  const Polynomial phi_12 = b(constraints[0], constraints[1]);
  const auto at = [&](const Polynomial& x) { return x.at(z); };
  // (3.20), the sums I, J, K of one constraint and D, E, F of both.
  const auto one = [&](std::size_t i, const std::vector<Polynomial>& left, const Polynomial& x,
                       const std::vector<Polynomial>& right, const Polynomial& y) {
    return at(b(left[i], y)) + at(b(x, right[i])) + at(b(constraints[i], b(x, y)));
  };
  const auto both = [&](const std::vector<Polynomial>& a, const Polynomial& x) {
    return at(b(constraints[1], a[0])) + at(b(a[1], constraints[0])) + at(b(x, phi_12));
  };
  const std::vector<Rational> i{one(0, as, f, bs, g), one(1, as, f, bs, g)},
      j{one(0, as, f, cs, h), one(1, as, f, cs, h)}, k{one(0, cs, h, bs, g), one(1, cs, h, bs, g)};
  const Rational d = both(as, f), e = both(bs, g), last = both(cs, h), w = Rational(1) / at(phi_12);
  const std::vector<Rational> a{at(as[0]), at(as[1])}, c{at(cs[0]), at(cs[1])}, m{at(bs[0]), at(bs[1])};
  const Rational base = at(b(f, b(g, h))) + at(b(g, b(h, f))) + at(b(h, b(f, g)));
  const Rational first =
      (a[1] * k[0] - a[0] * k[1]) + (m[1] * j[0] - m[0] * j[1]) + (c[0] * i[1] - c[1] * i[0]);
  const Rational second =
      (a[0] * m[1] - a[1] * m[0]) * last + (c[0] * a[1] - c[1] * a[0]) * e + (m[0] * c[1] - m[1] * c[0]) * d;
  return base + first * w + second * w * w;
}

}  // namespace pfaff::printed
