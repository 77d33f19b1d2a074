// A constrained system at one state, written out with dense matrices in quad: brackets of the constraints and
// what follows from their definitions, beside what formulations make of it.
#pragma once

#include <memory>
#include <string>

#include <pfaff/bench/reproduce/rows.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff::nguyen_turski {

class ConstrainedPoint {
 public:
  /// The initial state of a system, moved off its constraints by numbers of size `off`.
  ConstrainedPoint(const std::string& system, const Assignments& set, const Quad& off);

  [[nodiscard]] std::size_t count() const { return count_; }  // K
  [[nodiscard]] std::size_t axes() const { return axes_; }    // of space
  [[nodiscard]] MatrixStructure structure() const { return constraints_->pattern().structure(); }
  [[nodiscard]] const Numbers& q() const { return q_; }
  [[nodiscard]] const Numbers& velocity() const { return velocity_; }
  [[nodiscard]] const Numbers& residuals() const { return residuals_; }  // phi
  [[nodiscard]] Quad energy() const;
  [[nodiscard]] Quad mass(std::size_t bead) const;
  [[nodiscard]] Quad friction(std::size_t bead) const;

  /// S = {phi, phi~}, A = {phi~, phi~}, W of both levels, S^D = <phi~, phi~>.
  [[nodiscard]] Matrix<Quad> s() const { return gradient_ * momentum_gradient_.transposed(); }
  [[nodiscard]] Matrix<Quad> a() const;
  [[nodiscard]] Matrix<Quad> w() const;
  [[nodiscard]] Matrix<Quad> s_friction() const;

  /// The rates of q and p in a formulation, with its friction form where one is named.
  [[nodiscard]] Numbers rates(const std::string& formulation, const std::string& form = "") const;
  /// {z, H} - {z, phi_i} (W^-1)_ij {phi_j, H}, the definition (1.2), without friction.
  [[nodiscard]] Numbers rates_by_definition() const;
  /// Multipliers S^-1 (T v + P f) on the forces, (A.5), without friction.
  [[nodiscard]] Numbers rates_with_multipliers() const;
  /// dH/dt in a formulation.
  [[nodiscard]] double energy_rate(const std::string& formulation, const std::string& form) const;

  /// log |S| / 2 at positions moved by `by` along coordinate k, for the metric potential with kT = 1.
  [[nodiscard]] Quad half_log_determinant(std::size_t k, const Quad& by) const;
  /// Its gradient, tr(S^-1 dS) / 2 with dS from the second derivatives of the constraints.
  [[nodiscard]] Numbers half_log_gradient() const;

 private:
  [[nodiscard]] Matrix<Quad> gradient_at(const Numbers& q) const;

  std::shared_ptr<const Model> model_;
  std::unique_ptr<HolonomicConstraints<Quad>> constraints_;
  std::size_t n_, count_, axes_;
  Numbers q_, p_, velocity_, force_, residuals_, hidden_, friction_, inverse_mass_;
  Matrix<Quad> gradient_, momentum_gradient_, position_gradient_;  // B, P and T
};

}  // namespace pfaff::nguyen_turski
