// Coefficients of the Lobatto IIIA-IIIB pair of any number of stages, computed to quad accuracy.
#pragma once

#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// The s-stage Lobatto IIIA-IIIB pair (hairer-lubich-wanner2006 II.1.4, IV.2.2): order 2 s - 2, symmetric,
/// symplectic together. The first row of IIIA and the last column of IIIB are zero.
struct LobattoCoefficients {
  int stages = 0;
  std::vector<Quad> nodes;      // c_i in [0, 1], ascending, both ends included
  std::vector<Quad> weights;    // b_i
  std::vector<Quad> positions;  // IIIA, row-major: collocation at the nodes
  std::vector<Quad> momenta;    // IIIB, row-major: b_i a^_ij + b_j a_ji = b_i b_j
  /// The inverse of the rows 2 ... s and columns 1 ... s - 1 of the product IIIA IIIB, row-major. With it the
  /// multipliers are found that displace the stages by given amounts.
  std::vector<Quad> multipliers;
};

/// Nodes by Newton's method on the derivative of a Legendre polynomial. `stages` >= 2.
LobattoCoefficients lobatto_coefficients(int stages);

/// G = (W A^)^-1 W, (s - 1) x s and row-major, where A^ are the first s - 1 columns of IIIB and W_ki = b_i
/// c_i^(k - 1) for k = 1 ... s - 1. Of stages whose momenta satisfy W psi(Q, P) = 0 up to a residual psi, G
/// psi is what corrects the multipliers, but for the factor 1/h and the matrix S. With the conditions D(s) of
/// IIIB, (W A^)_kj = b_j (1 - c_j^k)/k.
std::vector<Quad> velocity_multipliers(const LobattoCoefficients& pair);

}  // namespace pfaff
