// Gauss-Legendre quadrature in quad: exact for polynomials of degree 2 n - 1, not for the next one.
#include <gtest/gtest.h>

#include <cmath>

#include <pfaff/core/numbers/gauss_legendre.hpp>

namespace {
using namespace pfaff;

// The error of the integral of x^power over [0, 1].
double integration_error(const std::vector<QuadratureNode>& nodes, int power) {
  Quad sum(0);
  for (const QuadratureNode& node : nodes) {
    Quad x(1);
    for (int k = 0; k < power; ++k) x = x * node.place.quad();
    sum += node.weight.quad() * x;
  }
  return static_cast<double>(abs(sum - Quad(1) / Quad(power + 1)));
}

TEST(GaussLegendre, IsExactForPolynomials) {
  for (const int n : {1, 2, 5, 40}) {
    const auto nodes = gauss_legendre(n);
    ASSERT_EQ(nodes.size(), static_cast<std::size_t>(n));
    for (int power = 0; power < 2 * n; ++power)
      EXPECT_LE(integration_error(nodes, power), 1e-33) << n << " " << power;
    if (n < 10) {
      EXPECT_GT(integration_error(nodes, 2 * n), 1e-8) << n;
    }
    for (const QuadratureNode& node : nodes) EXPECT_TRUE(node.place.value() > 0 && node.place.value() < 1);
  }
}

}  // namespace
