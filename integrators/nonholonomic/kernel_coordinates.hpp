// Coordinates (q, pi) of the surface A(q, t) v = 0 of a canonical system with H quadratic in p, from tapes.
//
// The columns of X(q), n x r, are a basis of ker A. Velocities are v = X u, and with pi = X^T p
//
//   H_d(q, pi) = H(q, p),  where p is the momentum with X^T p = pi and A H_p(q, p) = 0
//   q' = X H_d,pi,   pi' = -X^T H_d,q + Gam H_d,pi,   Gam_ab = -p.(DX_b X_a - DX_a X_b)
//
// is nonholonomic motion (celledoni-farre-hoiseth-martin2019). Gam is skew, so that H_d is kept.
//
// The basis consists of minors of A. Let C be the coordinates whose columns of A are not zero, D as many of
// them as there are constraints. For each coordinate a in C that is not in D there is the vector with det A_D
// at a and, by Cramer's rule, the negative determinants of A_D with one column replaced by A_a at D; for each
// other coordinate its unit vector. Nothing is divided by.
//
// One basis has to serve everywhere: a step depends on the basis, and if that were chosen at the start of
// each step, steps back would be made with another one than the steps that they undo, and the method would
// not be symmetric. There are two kinds. Where C has one coordinate more than there are constraints, the
// basis is the same up to signs whatever D is, and is one wherever A has its rank. Elsewhere D is the choice
// with the largest determinant that is a constant. Systems without one, or with one that is small beside
// other determinants, have no such coordinates here.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The coordinates, n positions and r momenta pi, as tapes.
struct KernelCoordinates {
  std::size_t degrees = 0, rank = 0;     // n, r
  std::shared_ptr<const Tape> energy;    // (q, pi) -> H_d
  std::shared_ptr<const Tape> middle;    // (q, pi) -> H_d,q, H_d,pi, X (row-major), Gam (row-major)
  std::shared_ptr<const Tape> momentum;  // (q, pi) -> p
  std::shared_ptr<const Tape> reduced;   // (q, p) -> pi
};

/// Why the model has no such coordinates, as the predicate of a sentence; empty where it has.
std::string no_kernel_coordinates(const Model& model);

/// Records them.
std::shared_ptr<const KernelCoordinates> kernel_coordinates(const Model& model);

}  // namespace pfaff
