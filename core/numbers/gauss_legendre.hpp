// Gauss-Legendre quadrature on [0, 1], to quad accuracy: n nodes integrate polynomials of degree 2 n - 1
// exactly, and analytic functions with an error that falls geometrically with n.
#pragma once

#include <vector>

#include <pfaff/core/numbers/real.hpp>

namespace pfaff {

struct QuadratureNode {
  Real place, weight;
};

/// The n >= 1 nodes in (0, 1), in descending order, and their weights, whose sum is 1. They are computed
/// once in a process.
std::vector<QuadratureNode> gauss_legendre(int n);

}  // namespace pfaff
