// How far states are from the constraints of their system, and the projection that moves them back onto
// these.
#pragma once

#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// Names of the numbers that ConstraintResiduals measures, in its order. "constraint" is max |phi| over all
/// constraints, those of velocities included; "hidden-constraint" is max |phi~| over the hidden constraints
/// phi~ = d phi / dt, and is there only where the constraints are holonomic. Empty for a model without
/// constraints.
std::vector<std::string> constraint_residual_names(const Model& model);

/// The largest residual of each level of constraints at a state: of phi, and of phi~ where the constraints
/// are holonomic.
template <class T>
class ConstraintResiduals {
 public:
  explicit ConstraintResiduals(const Model& model) {
    if (!model.restricted()) return;
    if (model.holonomic()) {
      holonomic_ = model.holonomic_constraints<T>();
      values_.resize(holonomic_->count());
    } else {
      phase_space_.emplace_back(model.tape(Formula::constraints));
      values_.resize(phase_space_.front().tape().outputs.size());
    }
  }
  /// Fills `residuals` with one number for each of constraint_residual_names(); a number is not-a-number
  /// where any residual of its level is.
  void operator()(const T& t, const std::vector<T>& z, std::vector<T>& residuals) {
    residuals.clear();
    if (holonomic_ != nullptr) {
      const std::size_t n = z.size() / 2;
      const std::span<const T> state(z);
      holonomic_->values(t, state.first(n), values_);
      residuals.push_back(largest());
      holonomic_->hidden_values(t, state.first(n), state.subspan(n), values_);
      residuals.push_back(largest());
    } else if (!phase_space_.empty()) {
      phase_space_.front()(t, z.data(), values_.data());
      residuals.push_back(largest());
    }
  }

 private:
  [[nodiscard]] T largest() const {
    T worst(0);
    for (const T& x : values_) {
      if (isnan(x)) return x;
      if (abs(x) > worst) worst = abs(x);
    }
    return worst;
  }
  std::unique_ptr<HolonomicConstraints<T>> holonomic_;
  std::vector<Replay<T>> phase_space_;
  std::vector<T> values_;
};

/// Names of the velocity constraints psi in the order of VelocityConstraints: the hidden ones of holonomic
/// constraints, then those of velocities themselves.
std::vector<std::string> velocity_constraint_names(const Model& model);

/// Why velocity constraints define no motion at a state, as a whole sentence with the names of the rows of A:
/// a row is zero or depends on others, or no velocity meets all constraints. Empty where they define one.
std::string dependent_velocity_constraints(const Model& model, const Quad& t, const std::vector<Quad>& z);

/// What it took to bring a state onto its constraints.
struct ProjectionOntoConstraints {
  Status status = Status::converged;
  double change = 0;  // the largest relative change, of positions or of momenta
  std::string worst;  // the constraint that was farthest off, by its name
  double worst_residual = 0;
};

/// Moves `z` at time `t` onto the constraints by Newton's method in quad. Holonomic constraints are met in
/// two stages: positions move along M^-1 B^T until phi = 0, then momenta along B^T until phi~ = 0. Where
/// velocities are constrained, momenta move along A^T until A v + b = 0, which for a quadratic H is the
/// projection in the metric of the masses; holonomic constraints beside them are met by positions first. For
/// all other constraints the state moves along their gradients.
ProjectionOntoConstraints project_onto_constraints(const Model& model, const Quad& t, std::vector<Quad>& z);

}  // namespace pfaff
