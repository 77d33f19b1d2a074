// Friction of constrained motion: two forms that differ (nguyen-turski (4.2), corrected; (A.5)).
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

#include <pfaff/core/facets/holonomic.hpp>

namespace pfaff {

/// The choices of the parameter friction-form.
inline std::vector<std::string> friction_forms() { return {"metriplectic", "stokes", "none"}; }

template <class T>
struct FrictionWork {
  FrictionWork(std::size_t degrees, std::size_t count) : drag(degrees), force(degrees), multipliers(count) {}
  std::vector<T> drag, force, multipliers;
};

/// True where there is no friction to add.
template <class T>
bool is_frictionless(const HolonomicConstraints<T>& constraints, const std::string& form) {
  return constraints.friction().empty() || form == "none";
}

/// Adds the friction of the state last placed to p_rate.
template <class T>
Status add_friction(HolonomicConstraints<T>& constraints, const std::string& form, Out<T> p_rate,
                    FrictionWork<T>& work) {
  if (is_frictionless(constraints, form)) return Status::converged;
  const In<T> lambda = constraints.friction();
  const In<T> v = constraints.velocities();
  const std::size_t n = v.size();
  for (std::size_t k = 0; k < n; ++k) work.drag[k] = lambda[k] * v[k];
  constraints.hidden_by_momentum(work.drag, work.multipliers);
  if (form == "stokes") {
    constraints.solve(work.multipliers, work.multipliers);
    constraints.apply_transpose(work.multipliers, work.force);
    for (std::size_t k = 0; k < n; ++k) p_rate[k] = p_rate[k] - work.drag[k] + work.force[k];
    return Status::converged;
  }
  const Status status = constraints.factor_friction();
  constraints.solve_friction(work.multipliers, work.multipliers);
  constraints.hidden_by_momentum_transpose(work.multipliers, work.force);
  for (std::size_t k = 0; k < n; ++k) p_rate[k] = p_rate[k] - lambda[k] * (v[k] - work.force[k]);
  return status;
}

}  // namespace pfaff
