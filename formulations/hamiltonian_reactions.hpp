// Dirac's equations of motion of holonomic constraints (nguyen-turski (4.2)), as an operation on constraints
// of any scalar:
//
//   mu = S^-1 phi~,   A_ij = {phi~_i, phi~_j} = T P^T - P T^T
//   q' = v - P^T mu,   p' = -H_q - B^T S^-1 (h - A mu) + T^T mu + friction
//
// Symbols are those of core/facets/holonomic.hpp. Without friction, constraints that offer these rates as one
// operation are asked for them.
#pragma once

#include <vector>

#include <pfaff/formulations/friction.hpp>

namespace pfaff {

template <class T>
class HamiltonianReactions {
 public:
  HamiltonianReactions(FrictionForm form, HolonomicConstraints<T>& constraints)
      : multipliers_(constraints.count()),
        right_(constraints.count()),
        other_(constraints.count()),
        by_momentum_(constraints.degrees()),
        by_position_(constraints.degrees()),
        friction_(form, constraints),
        rates_(friction_.none() ? constraints.rates(Reactions::hamiltonian) : nullptr) {}

  Status operator()(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
                    Out<T> p_rate) {
    if (rates_ != nullptr) return (*rates_)(t, q, p, q_rate, p_rate);
    const Status status = constraints.place(t, q, p);
    constraints.solve(constraints.hidden(), multipliers_);                 // mu
    constraints.hidden_by_momentum_transpose(multipliers_, by_momentum_);  // P^T mu
    constraints.hidden_by_position_transpose(multipliers_, by_position_);  // T^T mu
    constraints.hidden_by_position(by_momentum_, right_);                  // T P^T mu
    constraints.hidden_by_momentum(by_position_, other_);                  // P T^T mu
    const In<T> rates = constraints.hidden_rates(), v = constraints.velocities(), f = constraints.forces();
    for (std::size_t k = 0; k < right_.size(); ++k) right_[k] = rates[k] - (right_[k] - other_[k]);
    constraints.solve(right_, right_);
    constraints.apply_transpose(right_, p_rate);
    for (std::size_t k = 0; k < q.size(); ++k) {
      q_rate[k] = v[k] - by_momentum_[k];
      p_rate[k] = f[k] - p_rate[k] + by_position_[k];
    }
    const Status rubbed = friction_.add(constraints, p_rate);
    return status == Status::converged ? rubbed : status;
  }

 private:
  std::vector<T> multipliers_, right_, other_, by_momentum_, by_position_;
  Friction<T> friction_;
  ConstrainedRates<T>* rates_;  // the whole field as one operation, where there is one
};

}  // namespace pfaff
