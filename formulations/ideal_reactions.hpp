// The equations of motion with ideal reactions, which the formulations that solve for Lagrange's multipliers
// share:
//
//   q' = v,   p' = -H_q - B^T lambda + friction,   S lambda = h + c
//
// Here c = 0 makes phi~' = 0 (nguyen-turski (4.7), (A.5)); any other c makes phi~' = -c, by which constraints
// are stabilised. Without friction and with c = 0, constraints that offer these rates as one operation are
// asked for them.
#pragma once

#include <vector>

#include <pfaff/formulations/friction.hpp>

namespace pfaff {

template <class T>
class IdealReactions {
 public:
  IdealReactions(FrictionForm form, HolonomicConstraints<T>& constraints)
      : multipliers_(constraints.count()),
        friction_(form, constraints),
        rates_(friction_.none() ? constraints.rates(Reactions::ideal) : nullptr) {}

  /// The rates with c = 0.
  Status operator()(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
                    Out<T> p_rate) {
    if (rates_ != nullptr) return (*rates_)(t, q, p, q_rate, p_rate);
    const Status status = constraints.place(t, q, p);
    constraints.solve(constraints.hidden_rates(), multipliers_);
    return move(constraints, status, q_rate, p_rate);
  }

  /// The rates with h + c = stabilised(k, h) for constraint k. The function is called after the constraints
  /// have been placed, so that it can read phi and phi~.
  template <class Stabilised>
  Status operator()(HolonomicConstraints<T>& constraints, const T& t, In<T> q, In<T> p, Out<T> q_rate,
                    Out<T> p_rate, const Stabilised& stabilised) {
    const Status status = constraints.place(t, q, p);
    const In<T> rates = constraints.hidden_rates();
    for (std::size_t k = 0; k < multipliers_.size(); ++k) multipliers_[k] = stabilised(k, rates[k]);
    constraints.solve(multipliers_, multipliers_);
    return move(constraints, status, q_rate, p_rate);
  }

 private:
  Status move(HolonomicConstraints<T>& constraints, Status status, Out<T> q_rate, Out<T> p_rate) {
    constraints.apply_transpose(multipliers_, p_rate);
    const In<T> v = constraints.velocities(), f = constraints.forces();
    for (std::size_t k = 0; k < q_rate.size(); ++k) {
      q_rate[k] = v[k];
      p_rate[k] = f[k] - p_rate[k];
    }
    const Status rubbed = friction_.add(constraints, p_rate);
    return status == Status::converged ? rubbed : status;
  }

  std::vector<T> multipliers_;
  Friction<T> friction_;
  ConstrainedRates<T>* rates_;
};

}  // namespace pfaff
