// A bead-rod system of the engine at one state, in quad: what its brackets, constraints and formulations give
// there.
#pragma once

#include <memory>
#include <string>

#include <pfaff/core/facets/holonomic.hpp>
#include <pfaff/papers/evidence.hpp>
#include <pfaff/runs/support/constraint_brackets.hpp>
#include <pfaff/systems/bead_rod/description.hpp>

namespace pfaff::nguyen_turski {

/// The model of a description, for masses and friction that differ from bead to bead.
std::shared_ptr<const Model> bead_rod_model(const BeadRodDescription& description);

class BeadRodPoint {
 public:
  BeadRodPoint(std::shared_ptr<const Model> model, Numbers z);

  [[nodiscard]] const Numbers& z() const { return z_; }
  [[nodiscard]] Numbers q() const;
  [[nodiscard]] Numbers p() const;
  [[nodiscard]] MatrixStructure structure() const { return constraints_->pattern().structure(); }
  /// phi, phi~ and {phi~, H} as the constraints themselves give them.
  [[nodiscard]] Numbers constraints() const;
  [[nodiscard]] Numbers hidden_constraints() const;
  [[nodiscard]] Numbers hidden_rates() const;
  /// -dH/dq, friction left out, and the friction coefficients.
  [[nodiscard]] Numbers force() const;
  [[nodiscard]] Numbers friction() const;

  /// S = {phi, phi~} and A = {phi~, phi~}, Poisson brackets of the constraints; W of both, phi first.
  [[nodiscard]] Matrix<Quad> s() const;
  [[nodiscard]] Matrix<Quad> a() const;
  [[nodiscard]] Matrix<Quad> w() const;
  /// The inverses of S and of S^D = <phi~, phi~> by the solvers that the formulations use.
  [[nodiscard]] Matrix<Quad> s_inverse() const;
  [[nodiscard]] Matrix<Quad> s_friction_inverse() const;

  /// q' and p' in a formulation, with its form of friction.
  [[nodiscard]] Numbers rates(const std::string& formulation, const std::string& friction) const;
  /// The multipliers that `pfaff evaluate` shows of the formulation lmm, without friction.
  [[nodiscard]] Numbers multipliers() const;
  /// P u of the constraints, P = dphi~/dp.
  [[nodiscard]] Numbers hidden_by_momentum(const Numbers& u) const;
  [[nodiscard]] Quad energy() const;
  /// dH/dt in a formulation.
  [[nodiscard]] Quad energy_rate(const std::string& formulation, const std::string& friction) const;

 private:
  [[nodiscard]] std::shared_ptr<const Model> moving(const std::string& formulation,
                                                    const std::string& friction) const;
  std::shared_ptr<const Model> model_;
  std::unique_ptr<HolonomicConstraints<Quad>> constraints_;
  Numbers z_;
  ConstraintBrackets<Quad> brackets_;
};

}  // namespace pfaff::nguyen_turski
