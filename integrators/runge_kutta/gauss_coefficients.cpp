#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>

#include <cmath>
#include <numbers>

namespace pfaff {

namespace {
// Legendre polynomial of degree n on [-1, 1] and its derivative.
void legendre(int n, Quad x, Quad& value, Quad& slope) {
  Quad previous(1);
  value = x;
  for (int k = 2; k <= n; ++k) {
    const Quad next = (Quad(2 * k - 1) * x * value - Quad(k - 1) * previous) / Quad(k);
    previous = value;
    value = next;
  }
  slope = Quad(n) * (x * value - previous) / (x * x - Quad(1));
}
}  // namespace

Quad lagrange(const std::vector<Quad>& nodes, std::size_t j, Quad x) {
  Quad product(1);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (k != j) product *= (x - nodes[k]) / (nodes[j] - nodes[k]);
  return product;
}

GaussCoefficients gauss_coefficients(int stages) {
  const auto s = static_cast<std::size_t>(stages);
  GaussCoefficients g{stages, std::vector<Quad>(s), std::vector<Quad>(s), std::vector<Quad>(s * s)};
  for (std::size_t i = 0; i < s; ++i) {
    const std::size_t mirror = s - 1 - i;
    if (mirror < i) {  // the upper half mirrors the lower one, exactly
      g.nodes[i] = Quad(1) - g.nodes[mirror];
      g.weights[i] = g.weights[mirror];
      continue;
    }
    Quad x(-std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (static_cast<double>(s) + 0.5)));
    if (mirror == i) x = Quad(0);
    Quad value, slope;
    for (int iteration = 0; iteration < 8 && mirror != i; ++iteration) {
      legendre(stages, x, value, slope);
      x -= value / slope;
    }
    legendre(stages, x, value, slope);
    g.nodes[i] = (Quad(1) + x) / Quad(2);
    g.weights[i] = Quad(1) / ((Quad(1) - x * x) * slope * slope);
  }
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < s; ++j) {
      Quad sum(0);
      for (std::size_t k = 0; k < s; ++k) sum += g.weights[k] * lagrange(g.nodes, j, g.nodes[i] * g.nodes[k]);
      g.matrix[i * s + j] = g.nodes[i] * sum;
    }
  return g;
}

}  // namespace pfaff
