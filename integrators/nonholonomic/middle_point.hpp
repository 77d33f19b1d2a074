// The middle of a step of size h from (q0, p0), for methods whose discrete Lagrangian is h L at the middle:
//
//   pm = p0 + (h/2) (f(qm, pm) - A(q0)^T lambda),   qm = q0 + (h/2) v(qm, pm),   psi(qm, pm) = 0
//
// with v = H_p, f = -H_q and psi = A v + b at the time of the middle. This is -D1 L_d(q0, q1) = p0 - (h/2)
// A(q0)^T lambda for L_d = h L((q0 + q1)/2, (q1 - q0)/h), without a mass matrix: any H that is regular in p
// will do. Without constraints in the middle, lambda = 0.
//
// The equations are iterated to round-off from slopes and multipliers that are extrapolated from those of
// past steps. lambda is corrected by a simplified Newton method with S = A H_pp A^T as it is placed, at q0,
// in place of A(qm) H_pp A(q0)^T.
#pragma once

#include <algorithm>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/integrators/nonholonomic/energy_slopes.hpp>
#include <pfaff/integrators/support/coordinate_convergence.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>
#include <pfaff/integrators/support/remembered_contraction.hpp>
#include <pfaff/integrators/support/settling_convergence.hpp>

namespace pfaff {

/// Solves for the middle of steps of one integration, and remembers past ones.
template <class T>
class MiddlePoint {
 public:
  /// `count` is the number of constraints that hold in the middle; 0 where none of them do.
  MiddlePoint(const std::shared_ptr<const Model>& model, std::size_t count)
      : slopes_(model),
        velocity_(static_cast<std::size_t>(model->dimension()) / 2),
        force_(n()),
        reaction_(n()),
        position_(n()),
        momentum_(n()),
        kick_(n()),
        correction_(n()),
        multiplier_(count),
        residual_(count),
        predictor_(2 * n() + count, static_cast<std::size_t>(difference_levels<T>) + 2) {}

  /// v, f and A(q0)^T lambda as found.
  [[nodiscard]] In<T> velocity() const { return velocity_; }
  [[nodiscard]] In<T> force() const { return force_; }
  [[nodiscard]] In<T> reaction() const { return reaction_; }

  /// Finds the middle of a step of size h from q0 + q_carry and p0 + p_change at t; `half` is the way to the
  /// middle. The constraints must have been placed at q0.
  template <class P>
  Status solve(const P& p, VelocityConstraints<T>& c, const T& t, const T& h, const T& half, In<T> q0,
               In<T> q_carry, In<T> p0, In<T> p_change) {
    predict(p, c, t, h, half, q0, q_carry, p0, p_change);
    const T middle = t + half;
    CoordinateConvergence<T, SettlingConvergence<T>> convergence;
    do {
      VectorCorrections<T> moved(convergence.each()), kicked(convergence.each());
      ++p.counters().fields;
      const bool separable = slopes_.separable();
      if (separable) {
        slopes_.velocity(middle, momentum_, velocity_);
      } else {
        slopes_(middle, position_, momentum_, velocity_, force_);
      }
      for (std::size_t k = 0; k < n(); ++k) {
        const T change = half * velocity_[k] + q_carry[k], next = q0[k] + change;
        moved.against(next);
        moved.add(next - position_[k], next, change);
        position_[k] = next;
      }
      if (separable) slopes_.force(middle, position_, force_);
      for (std::size_t k = 0; k < n(); ++k) kick_[k] = momentum_after(k, half, p0, p_change) - momentum_[k];
      for (std::size_t k = 0; k < n(); ++k) momentum_[k] = momentum_[k] + kick_[k];
      if (!multiplier_.empty()) react(c, middle, half);
      for (std::size_t k = 0; k < n(); ++k) {
        kicked.against(momentum_[k]);
        kicked.against(p0[k]);
        kicked.add(kick_[k], momentum_[k], momentum_[k] - p0[k]);
      }
      convergence.begin_iteration();
      convergence.add(moved);
      convergence.add(kicked);
      ++p.counters().iterations;
    } while (!convergence.finished(100, contraction_));
    contraction_.remember_slowest(convergence.contraction());
    // Iterates that overflow come from a step that is too large, and are reported as not converged, too.
    return convergence.status() == Status::converged ? Status::converged : Status::not_converged;
  }

  /// The step whose middle was found is taken: what it was made of is remembered.
  void remember(const T& h) {
    predictor_.remember([this](std::size_t k) { return predicted(k); });
    last_h_ = h;
  }
  void forget() {
    predictor_.forget();
    contraction_.forget();
  }

 private:
  [[nodiscard]] std::size_t n() const { return velocity_.size(); }
  // The k-th of the numbers that are predicted.
  T& predicted(std::size_t k) {
    return k < n() ? velocity_[k] : k < 2 * n() ? force_[k - n()] : multiplier_[k - 2 * n()];
  }
  [[nodiscard]] T momentum_after(std::size_t k, const T& half, In<T> p0, In<T> p_change) const {
    return p0[k] + (half * (force_[k] - reaction_[k]) + p_change[k]);
  }

  // The point from which the iteration starts.
  template <class P>
  void predict(const P& p, VelocityConstraints<T>& c, const T& t, const T& h, const T& half, In<T> q0,
               In<T> q_carry, In<T> p0, In<T> p_change) {
    if (value_of(h) != value_of(last_h_)) forget();
    for (std::size_t k = 0; k < 2 * n() + multiplier_.size(); ++k) predicted(k) = predictor_.expected(k);
    for (std::size_t k = 0; k < n(); ++k) momentum_[k] = p0[k] + p_change[k];
    if (!predictor_.knows()) {
      ++p.counters().fields;
      slopes_(t, q0, momentum_, velocity_, force_);
    }
    if (multiplier_.empty()) {
      for (T& x : reaction_) x = T(0);
    } else {
      c.apply_transpose(multiplier_, reaction_);
    }
    for (std::size_t k = 0; k < n(); ++k) {
      position_[k] = q0[k] + (half * velocity_[k] + q_carry[k]);
      momentum_[k] = momentum_after(k, half, p0, p_change);
    }
  }

  // Corrects lambda, and with it the momentum and what it was corrected by.
  void react(VelocityConstraints<T>& c, const T& middle, const T& half) {
    c.values(middle, position_, momentum_, residual_);
    c.solve(residual_, residual_);
    const T per_half = T(1) / half;
    for (std::size_t i = 0; i < residual_.size(); ++i) {
      residual_[i] = per_half * residual_[i];
      multiplier_[i] = multiplier_[i] + residual_[i];
    }
    c.apply_transpose(residual_, correction_);
    for (std::size_t k = 0; k < n(); ++k) {
      reaction_[k] = reaction_[k] + correction_[k];
      const T change = half * correction_[k];
      momentum_[k] = momentum_[k] - change;
      kick_[k] = kick_[k] - change;
    }
  }

  EnergySlopes<T> slopes_;
  std::vector<T> velocity_, force_, reaction_, position_, momentum_, kick_, correction_, multiplier_,
      residual_;
  DifferencePredictor<T, dynamic, difference_levels<T> + 2> predictor_;
  RememberedContraction<Value<T>> contraction_;
  T last_h_{0};
};

}  // namespace pfaff
