// Friction of constrained motion, with coefficients Lambda of the momenta, in two forms that differ
// (nguyen-turski (4.2), corrected; (A.5)). Symbols are those of core/facets/holonomic.hpp.
//
// metriplectic: the symmetric Dirac bracket, -Lambda [v - P^T (S^D)^-1 P Lambda v] with S^D = P Lambda P^T
// and P = dphi~/dp. The reaction of the constraints to friction points along Lambda M^-1 B^T. Energy falls at
// the rate <H, H>_D.
// stokes: the drag -Lambda v with ideal (d'Alembert) constraint forces, -Lambda v + B^T S^-1 P Lambda v. The
// reaction points along B^T and does no work.
// They coincide where Lambda is a multiple of M. Both keep phi~' = 0.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/formulation.hpp>

namespace pfaff {

/// What formulations with friction derive from: the parameter friction-form, what it means, and the instances
/// in which all of its choices are verified.
struct WithFriction {
  std::string friction_form;

  explicit WithFriction(FrictionForm standard) : friction_form(to_string(standard)) {}

  [[nodiscard]] FrictionForm friction() const {
    for (const FrictionForm form : {FrictionForm::metriplectic, FrictionForm::stokes})
      if (friction_form == to_string(form)) return form;
    return FrictionForm::none;
  }
  static std::vector<Assignments> instances(bool /*full*/) {
    std::vector<Assignments> list;
    for (const char* form : {"metriplectic", "stokes", "none"}) list.push_back({{"friction-form", form}});
    return list;
  }

 protected:
  /// The parameter, for the list of formulation F.
  template <class F>
  static Parameter friction_parameter() {
    return parameter(static_cast<std::string F::*>(&F::friction_form), "friction-form",
                     {"metriplectic", "stokes", "none"},
                     "the symmetric Dirac bracket, Stokes drag with ideal constraint forces, or none");
  }
};

/// Friction in one form, for the constraints it is made with; none where these have no coefficients.
template <class T>
class Friction {
 public:
  Friction(FrictionForm form, const HolonomicConstraints<T>& constraints)
      : form_(constraints.friction().empty() ? FrictionForm::none : form),
        drag_(constraints.degrees()),
        force_(constraints.degrees()),
        multipliers_(constraints.count()) {}

  /// True where there is no friction to add.
  [[nodiscard]] bool none() const { return form_ == FrictionForm::none; }

  /// Adds the friction of the state last placed to p_rate.
  Status add(HolonomicConstraints<T>& constraints, Out<T> p_rate) {
    if (none()) return Status::converged;
    const In<T> lambda = constraints.friction();
    const In<T> v = constraints.velocities();
    const std::size_t n = v.size();
    for (std::size_t k = 0; k < n; ++k) drag_[k] = lambda[k] * v[k];
    constraints.hidden_by_momentum(drag_, multipliers_);
    if (form_ == FrictionForm::stokes) {
      constraints.solve(multipliers_, multipliers_);
      constraints.apply_transpose(multipliers_, force_);
      for (std::size_t k = 0; k < n; ++k) p_rate[k] = p_rate[k] - drag_[k] + force_[k];
      return Status::converged;
    }
    const Status status = constraints.factor_friction();
    constraints.solve_friction(multipliers_, multipliers_);
    constraints.hidden_by_momentum_transpose(multipliers_, force_);
    for (std::size_t k = 0; k < n; ++k) p_rate[k] = p_rate[k] - lambda[k] * (v[k] - force_[k]);
    return status;
  }

 private:
  FrictionForm form_;
  std::vector<T> drag_, force_, multipliers_;
};

}  // namespace pfaff
