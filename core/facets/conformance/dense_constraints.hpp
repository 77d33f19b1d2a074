// The holonomic constraints of a model at one point as dense matrices in quad, with which the operations of
// evaluators and the right-hand sides of formulations are compared. They are computed from the definitions.
//
// Everything comes from the formulas phi(q, t), H(q, p, t) and lambda(q, p, t) by differentiation and from
// dense algebra: no structure, no batching, no evaluator that an author wrote. B = dphi/dq, phi~ = B H_p +
// phi_t, P = dphi~/dp, T = dphi~/dq, h = T H_p - P H_q + phi~_t, S = P B^T.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

class Model;

class DenseConstraints {
 public:
  /// std::logic_error where the model has no holonomic constraints.
  explicit DenseConstraints(const Model& model);

  void place(Quad t, In<Quad> z);

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t degrees() const { return degrees_; }

  // At the point last placed; names as in HolonomicConstraints.
  std::vector<Quad> residuals, hidden, hidden_rates, velocities, forces;
  std::vector<Quad> friction;       // lambda, zeros where there is none
  Matrix<Quad> by_position;         // B
  Matrix<Quad> by_momentum;         // P
  Matrix<Quad> hidden_by_position;  // T
  Matrix<Quad> s;                   // P B^T

  /// An estimate of the condition of S from its inverse; infinite where it is singular.
  [[nodiscard]] double condition() const;

  /// (q', p') without friction: (H_p, -H_q) plus the reactions, of the sizes that their definition gives
  /// them. Not-a-number where these do not exist; empty for Reactions::other.
  [[nodiscard]] std::vector<Quad> rates(Reactions reactions) const;

  /// f - B^T S^-1 P f: what ideal reactions leave of a force f on the momenta.
  [[nodiscard]] std::vector<Quad> response(const std::vector<Quad>& f) const;

  /// What friction adds to p'. Metriplectic: -Lambda^1/2 (1 - Q) Lambda^1/2 v with the orthogonal projector Q
  /// on the range of Lambda^1/2 P^T. With ideal reactions (Stokes's drag): -Lambda v + B^T S^-1 P Lambda v.
  [[nodiscard]] std::vector<Quad> metriplectic_friction() const;
  [[nodiscard]] std::vector<Quad> stokes_friction() const;

 private:
  std::size_t count_, degrees_;
  Replay<Quad> everything_;
  std::vector<Quad> numbers_;
};

}  // namespace pfaff
