// The condition that a subspace F, such as the tangent space of a submanifold, is a Dirac subspace: F and
// P(F^0) meet in 0 alone. With it come the ranks and the angle by which it is judged.
#pragma once

#include <cstddef>
#include <string>

#include <pfaff/core/linear/matrix.hpp>

namespace pfaff {

/// How F = {v: A v = 0} lies to the image P(F^0) of its annihilator.
struct DiracSubspace {
  std::size_t annihilator = 0;  // dimension of F^0, the rank of A
  std::size_t image = 0;        // dimension of P(F^0), the rank of P A^T
  std::size_t brackets = 0;     // the rank of W = A P A^T
  double angle = 0;  // the smallest between a vector of F and one of P(F^0), in radians; pi/2 where one is 0

  /// F and P(F^0) meet in 0: nguyen-turski Definition 2, pitanga-rodrigues 3.2 (a).
  [[nodiscard]] bool meets_in_zero() const { return brackets == image; }
  /// No covector of F^0 is a Casimir's: pitanga-rodrigues 3.2 (b).
  [[nodiscard]] bool transversal() const { return image == annihilator; }
  /// E = F + P(F^0), which is (a) and (b), and W regular: there is a Dirac bracket.
  [[nodiscard]] bool splits() const { return meets_in_zero() && transversal(); }
};

/// Measures it for a tensor P (n x n) and the rows of A (K x n), gradients of constraints at a point of the
/// submanifold. Ranks are those of the numbers to working precision, or exact. T is double, Quad or Rational.
template <class T>
DiracSubspace dirac_subspace(const Matrix<T>& p, const Matrix<T>& a);

/// "TN and P(TN^0) meet in 0: angle 0.93 (brackets of the constraints have rank 2 of 2)".
std::string describe(const DiracSubspace& subspace);

}  // namespace pfaff
