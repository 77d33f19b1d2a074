#include <pfaff/integrators/constrained/lobatto_coefficients.hpp>

#include <cmath>
#include <numbers>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>

namespace pfaff {

namespace {
// The inner nodes are the zeros of P'_{s-1}; with (1 - x^2) P'_n = n (P_{n-1} - x P_n) and Legendre's
// equation, (1 - x^2) P''_n = 2 x P'_n - n (n + 1) P_n.
struct Legendre {
  Quad value, slope, curvature;
};
Legendre legendre(int n, Quad x) {
  Quad previous(1), value = x;
  for (int k = 2; k <= n; ++k) {
    const Quad next = (Quad(2 * k - 1) * x * value - Quad(k - 1) * previous) / Quad(k);
    previous = value;
    value = next;
  }
  const Quad below = Quad(1) - x * x;
  const Quad slope = Quad(n) * (previous - x * value) / below;
  return {value, slope, (Quad(2) * x * slope - Quad(n * (n + 1)) * value) / below};
}
}  // namespace

LobattoCoefficients lobatto_coefficients(int stages) {
  const auto s = static_cast<std::size_t>(stages);
  const int n = stages - 1;
  LobattoCoefficients l{stages,
                        std::vector<Quad>(s),
                        std::vector<Quad>(s),
                        std::vector<Quad>(s * s),
                        std::vector<Quad>(s * s),
                        std::vector<Quad>((s - 1) * (s - 1))};
  for (std::size_t i = 0; i < s; ++i) {
    const std::size_t mirror = s - 1 - i;
    if (mirror < i) {  // the upper half mirrors the lower one, exactly
      l.nodes[i] = Quad(1) - l.nodes[mirror];
      l.weights[i] = l.weights[mirror];
      continue;
    }
    Quad x(-std::cos(std::numbers::pi * static_cast<double>(i) / n)), value(1);  // P_n(-1)^2 = 1
    if (mirror == i) x = Quad(0);
    if (i > 0) {
      for (int iteration = 0; iteration < 12 && mirror != i; ++iteration) {
        const Legendre p = legendre(n, x);
        x -= p.slope / p.curvature;
      }
      value = legendre(n, x).value;
    } else {
      x = Quad(-1);
    }
    l.nodes[i] = (Quad(1) + x) / Quad(2);
    l.weights[i] = Quad(1) / (Quad(n * stages) * value * value);
  }
  // a_ij is the integral of the j-th Lagrange polynomial over [0, c_i]. Its degree is s - 1, so that Gauss
  // quadrature with s points is exact.
  const GaussCoefficients gauss = gauss_coefficients(stages);
  for (std::size_t i = 1; i + 1 < s; ++i)
    for (std::size_t j = 0; j < s; ++j) {
      Quad sum(0);
      for (std::size_t k = 0; k < s; ++k)
        sum += gauss.weights[k] * lagrange(l.nodes, j, l.nodes[i] * gauss.nodes[k]);
      l.positions[i * s + j] = l.nodes[i] * sum;
    }
  for (std::size_t j = 0; j < s; ++j) l.positions[(s - 1) * s + j] = l.weights[j];  // without rounding
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j + 1 < s; ++j)
      l.momenta[i * s + j] = l.weights[j] * (Quad(1) - l.positions[j * s + i] / l.weights[i]);
  LU<Quad> product(s - 1);
  for (std::size_t i = 1; i < s; ++i)
    for (std::size_t j = 0; j + 1 < s; ++j) {
      product(i - 1, j) = Quad(0);
      for (std::size_t k = 0; k < s; ++k) product(i - 1, j) += l.positions[i * s + k] * l.momenta[k * s + j];
    }
  product.factor();
  std::vector<Quad> unit(s - 1), column(s - 1);
  for (std::size_t j = 0; j + 1 < s; ++j) {
    std::fill(unit.begin(), unit.end(), Quad(0));
    unit[j] = Quad(1);
    product.solve(unit.data(), column.data());
    for (std::size_t i = 0; i + 1 < s; ++i) l.multipliers[i * (s - 1) + j] = column[i];
  }
  return l;
}

std::vector<Quad> velocity_multipliers(const LobattoCoefficients& pair) {
  const auto s = static_cast<std::size_t>(pair.stages);
  std::vector<Quad> means((s - 1) * s), result((s - 1) * s);
  for (std::size_t i = 0; i < s; ++i) {
    Quad weight = pair.weights[i];
    for (std::size_t k = 0; k + 1 < s; ++k, weight *= pair.nodes[i]) means[k * s + i] = weight;
  }
  LU<Quad> product(s - 1);
  for (std::size_t k = 0; k + 1 < s; ++k)
    for (std::size_t j = 0; j + 1 < s; ++j) {
      product(k, j) = Quad(0);
      for (std::size_t i = 0; i < s; ++i) product(k, j) += means[k * s + i] * pair.momenta[i * s + j];
    }
  product.factor();
  std::vector<Quad> right(s - 1), column(s - 1);
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t k = 0; k + 1 < s; ++k) right[k] = means[k * s + i];
    product.solve(right.data(), column.data());
    for (std::size_t j = 0; j + 1 < s; ++j) result[j * s + i] = column[j];
  }
  return result;
}

}  // namespace pfaff
