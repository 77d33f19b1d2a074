#include <pfaff/integrators/order_conditions/multistep_conditions.hpp>

#include <algorithm>

namespace pfaff {

namespace {

ComplexQuad operator-(const ComplexQuad& a, const ComplexQuad& b) {
  return {a.real - b.real, a.imaginary - b.imaginary};
}
ComplexQuad operator*(const ComplexQuad& a, const ComplexQuad& b) {
  return {a.real * b.real - a.imaginary * b.imaginary, a.real * b.imaginary + a.imaginary * b.real};
}
ComplexQuad operator/(const ComplexQuad& a, const ComplexQuad& b) {
  const Quad square = b.real * b.real + b.imaginary * b.imaginary;
  const ComplexQuad product = a * ComplexQuad{b.real, -b.imaginary};
  return {product.real / square, product.imaginary / square};
}
Quad modulus(const ComplexQuad& a) { return sqrt(a.real * a.real + a.imaginary * a.imaginary); }

std::string text_of(const ComplexQuad& z) {
  const bool negative = z.imaginary < Quad(0);
  return to_string(z.real, 6) + (negative ? " - " : " + ") + to_string(abs(z.imaginary), 6) + "i";
}

}  // namespace

std::vector<OrderCondition> multistep_conditions(const MultistepPolynomials& method, int order) {
  const auto steps = static_cast<int>(method.rho.size()) - 1;
  std::vector<OrderCondition> conditions;
  for (int q = 0; q <= order; ++q) {
    Quad sum(0), size(0);
    for (int j = 0; j <= steps; ++j) {
      const auto place = static_cast<std::size_t>(j);
      Quad before(1);  // (j/k)^(q-1)
      for (int n = 1; n < q; ++n) before *= Quad(j) / Quad(steps);
      const Quad power = q == 0 ? Quad(1) : before * Quad(j) / Quad(steps);
      const Quad value = power * method.rho[place],
                 slope = q == 0 ? Quad(0) : Quad(q) * before * method.sigma[place] / Quad(steps);
      sum += value - slope;
      size += abs(value) + abs(slope);
    }
    const std::string power = std::to_string(q);
    conditions.push_back({q == 0   ? "the sum of rho_j = 0"
                          : q == 1 ? "the sum of j rho_j - sigma_j = 0"
                                   : "the sum of j^" + power + " rho_j - " + power + " j^" +
                                         std::to_string(q - 1) + " sigma_j = 0",
                          std::max(q, 1), sum, std::max(Quad(1), size)});
  }
  return conditions;
}

std::vector<OrderCondition> second_order_multistep_conditions(const MultistepPolynomials& method, int order) {
  const auto steps = static_cast<int>(method.rho.size()) - 1;
  std::vector<OrderCondition> conditions;
  for (int q = 0; q <= order + 1; ++q) {
    Quad sum(0), size(0);
    for (int j = 0; j <= steps; ++j) {
      const auto place = static_cast<std::size_t>(j);
      const Quad ratio = Quad(j) / Quad(steps);
      Quad before(1);  // (j/k)^(q-2)
      for (int n = 2; n < q; ++n) before *= ratio;
      const Quad power = q == 0 ? Quad(1) : q == 1 ? ratio : before * ratio * ratio;
      const Quad value = power * method.rho[place],
                 curvature =
                     q < 2 ? Quad(0) : Quad(q * (q - 1)) * before * method.sigma[place] / Quad(steps * steps);
      sum += value - curvature;
      size += abs(value) + abs(curvature);
    }
    const std::string power = std::to_string(q);
    conditions.push_back({q == 0   ? "the sum of rho_j = 0"
                          : q == 1 ? "the sum of j rho_j = 0"
                          : q == 2 ? "the sum of j^2 rho_j - 2 sigma_j = 0"
                                   : "the sum of j^" + power + " rho_j - " + std::to_string(q * (q - 1)) +
                                         " j^" + std::to_string(q - 2) + " sigma_j = 0",
                          std::max(q - 1, 1), sum, std::max(Quad(1), size)});
  }
  return conditions;
}

std::vector<Quad> without_root_one(const std::vector<Quad>& rho) {
  std::vector<Quad> quotient(rho.size() - 1);
  Quad sum(0);
  for (std::size_t j = quotient.size(); j-- > 0;) quotient[j] = sum += rho[j + 1];
  return quotient;
}

std::vector<ComplexQuad> polynomial_roots(const std::vector<Quad>& coefficients) {
  if (coefficients.size() > 1 && coefficients.front() == Quad(0)) {
    // A root at 0 is known exactly, and several of them would slow the iteration down.
    auto roots = polynomial_roots(std::vector<Quad>(coefficients.begin() + 1, coefficients.end()));
    roots.emplace_back();
    return roots;
  }
  const std::size_t degree = coefficients.size() - 1;
  const Quad leading = coefficients.back();
  Quad radius(1);
  for (const Quad& c : coefficients) radius = std::max(radius, abs(c / leading));
  std::vector<ComplexQuad> roots;
  ComplexQuad start{radius, Quad(0)};
  const ComplexQuad turn{Quad(0.4), Quad(0.9)};  // no root of unity, so that no start is symmetric
  for (std::size_t k = 0; k < degree; ++k) roots.push_back(start = start * turn);
  constexpr int enough = 2000;  // multiple roots converge linearly, by a half a step or so
  for (int iteration = 0; iteration < enough; ++iteration) {
    Quad change(0);
    for (std::size_t k = 0; k < degree; ++k) {
      ComplexQuad value{Quad(1), Quad(0)}, others{Quad(1), Quad(0)};
      for (std::size_t j = degree; j-- > 0;) {
        value = value * roots[k];
        value.real += coefficients[j] / leading;
      }
      for (std::size_t j = 0; j < degree; ++j)
        if (j != k) others = others * (roots[k] - roots[j]);
      if (others.real == Quad(0) && others.imaginary == Quad(0)) continue;
      const ComplexQuad correction = value / others;
      roots[k] = roots[k] - correction;
      change = std::max(change, modulus(correction));
    }
    if (change <= Quad(1e-32)) break;
  }
  return roots;
}

std::string instability(const MultistepPolynomials& method) {
  const std::vector<ComplexQuad> roots = polynomial_roots(method.rho);
  const Quad one(1), near(1e-6), rounding(1e-12);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    const Quad size = modulus(roots[k]);
    if (size < one - near) continue;
    for (std::size_t j = 0; j < roots.size(); ++j)
      if (j != k && modulus(roots[k] - roots[j]) < near)
        return "rho has the multiple root " + text_of(roots[k]) + " on the unit circle or outside it";
    if (size > one + rounding)
      return "rho has the root " + text_of(roots[k]) + " of modulus " + to_string(size, 6) +
             ", outside the unit circle";
  }
  return {};
}

}  // namespace pfaff
