// The velocity constraints of a model at one point as dense matrices in quad, with which the operations of
// evaluators and the right-hand sides of formulations are compared. They are computed from the definitions.
//
// Everything comes from the formulas A(q, t), b(q, t), phi(q, t) and H(q, p, t) by differentiation and from
// dense algebra. Rows of A and b are those of core/facets/velocity_constraints.hpp: first dphi/dq and phi_t
// of holonomic constraints, then the author's. The two motions are solutions of the saddle-point system with
// the matrix [[M, A^T], [A, 0]], M = H_pp^-1, which neither eliminates multipliers nor knows S.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

class Model;

class DenseVelocityConstraints {
 public:
  /// std::logic_error where the model has no velocity constraints.
  explicit DenseVelocityConstraints(const Model& model);

  void place(Quad t, In<Quad> z);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t degrees() const { return degrees_; }
  /// How many of the rows, the first ones, are those of holonomic constraints.
  [[nodiscard]] std::size_t holonomic() const { return holonomic_; }

  // At the point last placed.
  std::vector<Quad> velocities, forces;  // v = H_p, -H_q
  std::vector<Quad> offsets;             // b
  std::vector<Quad> residuals;           // psi = A v + b
  std::vector<Quad> turning;             // A' v + b' along q' = v, t' = 1, with v held
  std::vector<Quad> drift;               // H_pq v + H_pt: what v' is without forces
  std::vector<Quad> rates;               // {psi, H} + psi_t = turning + A (drift - H_pp H_q)
  Matrix<Quad> rows;                     // A
  Matrix<Quad> by_position;              // dpsi/dq
  Matrix<Quad> by_momentum;              // P = A H_pp
  Matrix<Quad> s;                        // P A^T
  Matrix<Quad> inverse_mass;             // H_pp

  /// An estimate of the condition of S from its inverse; infinite where it is singular.
  [[nodiscard]] double condition() const;

  /// (q', p') of Lagrange and d'Alembert's motion: p' = -H_q - A^T lambda with psi' = 0, from the
  /// saddle-point system for v' and lambda. Not-a-number where it is singular.
  [[nodiscard]] std::vector<Quad> nonholonomic_motion() const;
  /// (q', p') of vakonomic motion, for H quadratic in p: the velocity w and the multipliers for which p =
  /// L_v(w)
  /// + A^T lambda and A w + b = 0, then q' = w and p' = L_q + (lambda.(A w + b))_q.
  [[nodiscard]] std::vector<Quad> vakonomic_motion();

 private:
  // The solution (x, lambda) of M x + A^T lambda = upper, A x = lower.
  [[nodiscard]] std::vector<Quad> saddle_point(const std::vector<Quad>& upper,
                                               const std::vector<Quad>& lower) const;

  std::size_t holonomic_, count_, degrees_;
  Replay<Quad> everything_, gradient_, reaction_;
  Quad time_;
  std::vector<Quad> numbers_, state_;
};

}  // namespace pfaff
