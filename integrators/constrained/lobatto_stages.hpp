// The stages of a step of a Lobatto IIIA-IIIB pair with reactions of constraints, R_j the reaction in stage
// j:
//
//   Q_i = q0 + h sum_j a_ij H_p(Q_j, P_j),   P_i = p0 + h sum_j a^_ij (-H_q(Q_j, P_j) - R_j)
//
// The last column of IIIB is zero: neither the force nor the reaction of the last stage enters into any P_i.
//
// With rates that are multiplied by the weights b_j, the coefficients are mu_ij = a_ij / b_j and
// mu^_ij = a^_ij / b_j, and the pair is symplectic where mu^_ij + mu_ji = 1. Here this holds exactly: mu_ij
// is rounded to a multiple of a power of two, so that 1 - mu_ij is not rounded. Where it is missed by a unit
// of round-off, the energy has a trend in each run (docs/drift-and-cost.md).
#pragma once

#include <span>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/constrained/lobatto_coefficients.hpp>
#include <pfaff/integrators/runge_kutta/collocation_coefficients.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>

namespace pfaff {

/// What methods with these stages work on, and what they remember of past steps.
template <class T>
struct LobattoStages {
  std::vector<T> b, c, mu, mu_hat, ones;
  // [stage][component]: Q, P, H_p, the force with its reactions; [stage][constraint]: the multipliers of all
  // stages but the last.
  std::vector<T> position, momentum, velocity, force, multiplier;
  std::vector<T> carry;                                // what the sums of q and p have rounded off
  std::vector<T> move, impulse, end;                   // of q and of p over the step, and a state at its end
  DifferencePredictor<T, dynamic, dynamic> predictor;  // of velocities, forces, multipliers
  T last_h{0};

  LobattoStages(const LobattoCoefficients& tableau, std::size_t degrees, std::size_t constraints)
      : b(converted(tableau.weights)),
        c(converted(tableau.nodes)),
        mu(b.size() * b.size()),
        mu_hat(mu.size()),
        ones(b.size(), T(1)),
        position(b.size() * degrees),
        momentum(position.size()),
        velocity(position.size()),
        force(position.size()),
        multiplier((b.size() - 1) * constraints),
        carry(2 * degrees),
        move(degrees),
        impulse(degrees),
        end(degrees),
        predictor(velocity.size() + force.size() + multiplier.size(),
                  static_cast<std::size_t>(difference_levels<T>)) {
    // Numbers between 2 and 4 have one spacing, and mu_ij lies between -1/2 and 3/2.
    const Value<T> offset = Value<T>(5) / Value<T>(2);
    for (std::size_t i = 0; i < s(); ++i)
      for (std::size_t j = 0; j < s(); ++j) {
        mu[i * s() + j] = T(on_grid(tableau.positions[i * s() + j] / tableau.weights[j], offset));
        mu_hat[j * s() + i] = T(1) - mu[i * s() + j];
      }
  }

  [[nodiscard]] std::size_t s() const { return b.size(); }
  [[nodiscard]] std::size_t n() const { return move.size(); }
  [[nodiscard]] std::size_t count() const { return multiplier.size() / (s() - 1); }
  Out<T> stage(std::vector<T>& all, std::size_t i) const { return Out<T>(all).subspan(i * n(), n()); }
  Out<T> constraint(std::vector<T>& all, std::size_t i) const {
    return Out<T>(all).subspan(i * count(), count());
  }
  /// sum_j factors_j b_j rates_j of the first `stages` stages, component k.
  T sum(const T* factors, const std::vector<T>& rates, std::size_t stages, std::size_t k) const {
    T total = factors[0] * (b[0] * rates[k]);
    for (std::size_t j = 1; j < stages; ++j) total = total + factors[j] * (b[j] * rates[j * n() + k]);
    return total;
  }
  /// h sum_j a_ij H_p(Q_j, P_j), component k.
  T displacement(const T& h, std::size_t i, std::size_t k) const {
    return h * sum(mu.data() + i * s(), velocity, s(), k);
  }
  /// P_i of a step from the state z, component k.
  T momentum_of(const T& h, const auto& z, std::size_t i, std::size_t k) const {
    return z[n() + k] + (h * sum(mu_hat.data() + i * s(), force, s() - 1, k) + carry[n() + k]);
  }

  /// Begins a step of size h from z: places the constraints there and fills in what an iteration starts from.
  template <class P, class Constraints>
  Status begin(const P& p, Constraints& constraints, const T& t, const T& h, const State<P>& z) {
    ++p.counters().factorisations;
    const Status status = constraints.linearise(t, In<T>(z.data(), n()), In<T>(z.data() + n(), n()));
    if (status == Status::converged) predict(p, constraints, t, h, z);
    return status;
  }
  /// Places the constraints at the end of the step, in Q_s, and fills `impulse` with the change of the
  /// momenta without the reaction there, h sum_j b_j (-H_q(Q_j, P_j) - R_j) with R_s = 0.
  template <class P, class Constraints>
  Status push_to_end(const P& p, Constraints& constraints, const T& t, const T& h) {
    const In<T> q = stage(position, s() - 1), p_s = stage(momentum, s() - 1);
    ++p.counters().factorisations;
    if (const Status status = constraints.linearise(t + h, q, p_s); status != Status::converged)
      return status;
    ++p.counters().fields;
    constraints.force(t + h, q, p_s, stage(force, s() - 1));
    for (std::size_t k = 0; k < n(); ++k) impulse[k] = h * sum(ones.data(), force, s(), k);
    return Status::converged;
  }
  /// Ends the step of size h whose stages these are, with the status that finding them has had: where they
  /// were found `move` and `impulse` are added to the state, else past steps are forgotten. Returns the
  /// status.
  Status take(Status status, const T& h, auto& z, bool compensated) {
    if (status != Status::converged) {
      predictor.forget();
      return status;
    }
    predictor.remember([this](std::size_t k) { return predicted(k); });
    last_h = h;
    for (std::size_t k = 0; k < n(); ++k) {
      add_to(z[k], carry[k], move[k], compensated);
      add_to(z[n() + k], carry[n() + k], impulse[k], compensated);
    }
    return status;
  }
  /// Forgets the past, round-off included: the next step depends on its state alone.
  void restart() {
    predictor.forget();
    for (T& x : carry) x = T(0);
  }

  /// Coefficients in the scalar of the method.
  static std::vector<T> converted(const std::vector<Quad>& numbers) {
    std::vector<T> list;
    for (const Quad& x : numbers) list.push_back(T(Real(x)));
    return list;
  }

 private:
  // Fills velocities, forces and multipliers of all stages with those to start an iteration from:
  // extrapolated ones where past steps are known, else those at the start of the step.
  template <class P, class Constraints>
  void predict(const P& p, Constraints& constraints, const T& t, const T& h, const State<P>& z) {
    const std::size_t all = velocity.size() + force.size() + multiplier.size();
    if (value_of(h) != value_of(last_h)) predictor.forget();
    for (std::size_t k = 0; k < all; ++k) predicted(k) = predictor.expected(k);
    if (predictor.knows()) return;
    const In<T> q(z.data(), n()), p0(z.data() + n(), n());
    constraints.velocity(t, q, p0, stage(velocity, 0));
    constraints.force(t, q, p0, stage(force, 0));
    ++p.counters().fields;
    for (std::size_t k = n(); k < velocity.size(); ++k) {
      velocity[k] = velocity[k - n()];
      force[k] = force[k - n()];
    }
  }
  // The k-th of the numbers that are predicted.
  T& predicted(std::size_t k) {
    if (k < velocity.size()) return velocity[k];
    k -= velocity.size();
    return k < force.size() ? force[k] : multiplier[k - force.size()];
  }
};

}  // namespace pfaff
