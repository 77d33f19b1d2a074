// Gauss collocation coefficients of any number of stages, computed to quad accuracy.
#pragma once

#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// The Butcher tableau of the s-stage Gauss method (hairer-lubich-wanner2006, II.1.3): order 2 s, symplectic,
/// symmetric.
struct GaussCoefficients {
  int stages = 0;
  std::vector<Quad> nodes;    // c_i in (0, 1), ascending, symmetric about 1/2
  std::vector<Quad> weights;  // b_i
  std::vector<Quad> matrix;   // a_ij, row-major
};

/// Nodes by Newton's method on the Legendre polynomial, weights from its derivative, a_ij = integral of the
/// j-th Lagrange polynomial over [0, c_i] by the quadrature itself, which is exact for it.
GaussCoefficients gauss_coefficients(int stages);

/// The value at x of the j-th Lagrange polynomial through `nodes`.
Quad lagrange(const std::vector<Quad>& nodes, std::size_t j, Quad x);

}  // namespace pfaff
