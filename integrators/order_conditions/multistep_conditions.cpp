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

// Condition number q of methods that reach derivative `derivative`, in powers of j/k,
//
//   sum_j (j^q rho_j - q (q - 1) ... j^(q - derivative) sigma_j) = 0,
//
// where the second term is missing for q < derivative.
OrderCondition condition(const MultistepPolynomials& method, int q, int derivative) {
  const auto steps = static_cast<int>(method.rho.size()) - 1;
  int factor = q < derivative ? 0 : 1, scale = 1;
  for (int n = 0; n < derivative; ++n) {
    if (factor != 0) factor *= q - n;
    scale *= steps;
  }
  Quad sum(0), size(0);
  for (int j = 0; j <= steps; ++j) {
    const auto place = static_cast<std::size_t>(j);
    const Quad ratio = Quad(j) / Quad(steps);
    Quad lower(1), power(1);  // (j/k)^(q - derivative) and (j/k)^q
    for (int n = derivative; n < q; ++n) lower *= ratio;
    for (int n = 0; n < q; ++n) power *= ratio;
    const Quad value = power * method.rho[place],
               slope = Quad(factor) * lower * method.sigma[place] / Quad(scale);
    sum += value - slope;
    size += abs(value) + abs(slope);
  }
  const auto of_j = [](int exponent) {
    return exponent == 0 ? std::string() : exponent == 1 ? "j " : "j^" + std::to_string(exponent) + " ";
  };
  std::string text = "the sum of " + of_j(q) + "rho_j";
  if (factor != 0)
    text += " - " + (factor == 1 ? "" : std::to_string(factor) + " ") + of_j(q - derivative) + "sigma_j";
  return {text + " = 0", std::max(q + 1 - derivative, 1), sum, std::max(Quad(1), size)};
}

// Up to `order` of methods that reach derivative `derivative`.
std::vector<OrderCondition> conditions_to(const MultistepPolynomials& method, int order, int derivative) {
  std::vector<OrderCondition> conditions;
  for (int q = 0; q <= order + derivative - 1; ++q) conditions.push_back(condition(method, q, derivative));
  return conditions;
}

}  // namespace

std::vector<OrderCondition> multistep_conditions(const MultistepPolynomials& method, int order) {
  return conditions_to(method, order, 1);
}

std::vector<OrderCondition> second_order_multistep_conditions(const MultistepPolynomials& method, int order) {
  return conditions_to(method, order, 2);
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
