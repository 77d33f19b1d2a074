// RATTLE for H = T(p) + V(q, t) with constraints phi(q, t) = 0, B = dphi/dq:
//
//   p' = p0 + h/2 (-V_q(q0, t0)) - B(q0)^T nu,  q1 = q0 + h T_p(p'),        phi(q1, t1) = 0
//   p1 = p' + h/2 (-V_q(q1, t1)) - B(q1)^T mu,                              phi~(q1, p1, t1) = 0
//
// (hairer-lubich-wanner2006 VII.1.4): order 2, symmetric, symplectic on the constraint surface, one force a
// step. Both levels of constraints hold to round-off after every step.
//
// The multipliers nu are those of the steps before, extrapolated, and corrected by Newton's method with
// S = B H_pp B^T at q0, whose factors the momenta at the end of the step before have needed already: a step
// factors once. How far a correction is from the last one is known from the contraction of steps before:
// every sixteenth starts from the multipliers of the step before it, so that there is a contraction to see.
// The update is compensated.
#pragma once

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/constraint_solves.hpp>
#include <pfaff/integrators/continuation.hpp>
#include <pfaff/integrators/difference_predictor.hpp>

namespace pfaff {

/// Why a method for H = T(p) + V(q, t) with holonomic constraints and no friction cannot run on a model.
inline std::string refuses_constrained_motion(const std::string& method, const Model& model) {
  if (!model.separable_energy())
    return method + " needs a constrained H = T(p) + V(q, t); the Hamiltonian of " + model.name() +
           " is not written as kinetic and potential energy";
  if (!model.frictionless())
    return method + " keeps energies and needs a system without friction; " + model.name() + " has friction";
  return {};
}

/// Half a kick, a drift onto phi = 0, half a kick onto phi~ = 0.
struct Rattle {
  /// The kick, the drift and the kick, in units of the step.
  std::array<Quad, 3> lengths{Quad(1) / Quad(2), Quad(1), Quad(1) / Quad(2)};
  bool compensated = true;

  static constexpr bool fixed_sizes = false;  // batched calls do the work

  static std::vector<Parameter> parameters() {
    return {parameter(&Rattle::compensated, "compensated", "compensated summation")};
  }
  std::span<Quad> coefficients() { return lengths; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    return refuses_constrained_motion("rattle", model);
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    static constexpr int watched_step = 16;
    T first, drift, last;
    bool linear;  // H_p is linear in p
    // Of the n positions: carries of q and p, forces at the start, impulses, momenta at the middle and the
    // end, velocities, displacements, positions at the end, reactions.
    std::vector<T> carry, force, impulse, momentum, velocity, displacement, position, reaction;
    std::vector<T> multiplier, residual, correction;
    DifferencePredictor<T, dynamic, dynamic> predictor;
    MomentumProjection<T> onto_hidden;
    Continuation<P> continuation;  // where the constraints are placed, and the force is that of
    T last_h{0};
    Value<T> contraction{0};  // of Newton's iteration, in the step that was watched; 0: in none yet
    int unwatched = 0;        // steps since then

    Work(const Rattle& method, const P& p)
        : first(Real(method.lengths[0])),
          drift(Real(method.lengths[1])),
          last(Real(method.lengths[2])),
          carry(p.size()),
          force(n()),
          impulse(n()),
          momentum(n()),
          velocity(n()),
          displacement(n()),
          position(n()),
          reaction(n()),
          multiplier(p.holonomic().count()),
          residual(multiplier.size()),
          correction(multiplier.size()),
          predictor(multiplier.size(), static_cast<std::size_t>(difference_levels<T>)),
          onto_hidden(p.holonomic()),
          continuation(p) {
      linear = velocity_is_linear<T>(p.holonomic(), T(0), position);
    }

    [[nodiscard]] std::size_t n() const { return carry.size() / 2; }
    /// Forgets the past, round-off included: the next step depends on its state alone.
    void restart() {
      forget();
      for (T& x : carry) x = T(0);
    }
    void forget() {
      forget_multipliers();
      continuation.forget();
    }
    void forget_multipliers() {
      predictor.forget();
      contraction = Value<T>(0);
    }
    /// The multipliers to start from.
    void expect_multipliers() {
      const bool watched = contraction == Value<T>(0) || ++unwatched >= watched_step;
      for (std::size_t i = 0; i < multiplier.size(); ++i)
        multiplier[i] = watched ? predictor.latest(i) : predictor.expected(i);
    }
    void watch(const Convergence<T>& convergence) {
      if (convergence.contraction() == Value<T>(0)) return;
      contraction = convergence.contraction();
      unwatched = 0;
    }
    /// The contraction to be expected, with a factor of 2 to spare; 1 where it is not known.
    [[nodiscard]] Value<T> expected_contraction() const {
      const bool known = contraction > Value<T>(0) && unwatched < watched_step;
      return known ? Value<T>(2) * contraction : Value<T>(1);
    }
    /// The step that follows is taken with `next`.
    void hand_over(Work& next) {
      if (this == &next) return;
      std::swap(carry, next.carry);
      std::swap(force, next.force);
      std::swap(continuation, next.continuation);
      continuation.forget();
    }
  };

  template <HasHolonomic P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    HolonomicConstraints<Scalar<P>>& c = p.holonomic();
    Status status = start(p, c, t, h, z, w);
    if (status == Status::converged) status = drift_onto_positions(p, c, t, h, z, w);
    if (status == Status::converged) status = kick_onto_momenta(p, c, t + h, h, z, w);
    return end(status, t, h, z, w);
  }

 protected:
  // Adds displacement and impulse to the state, or leaves it where a part of the step has failed.
  template <class P>
  Status end(Status status, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    if (status != Status::converged) {
      w.forget();
      return status;
    }
    const std::size_t n = w.n();
    for (std::size_t k = 0; k < n; ++k) {
      add_to(z[k], w.carry[k], w.displacement[k], compensated);
      add_to(z[n + k], w.carry[n + k], w.impulse[k], compensated);
    }
    w.predictor.remember([&w](std::size_t k) { return w.multiplier[k]; });
    w.last_h = h;
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

  // Constraints and force at the start: those of the end of the step before, where it ended here.
  template <class P>
  static Status start(const P& p, HolonomicConstraints<Scalar<P>>& c, const Scalar<P>& t, const Scalar<P>& h,
                      const State<P>& z, Work<P>& w) {
    if (w.continuation.holds_at(t, h, z)) return Status::converged;
    const std::size_t n = w.n();
    const In<Scalar<P>> q(z.data(), n), momentum(z.data() + n, n);
    ++p.counters().fields;
    c.force(t, q, momentum, w.force);
    ++p.counters().factorisations;
    return c.linearise(t, q, momentum);
  }

  // p' and q1: fills momentum, impulse, displacement and position.
  template <class P>
  static Status drift_onto_positions(const P& p, HolonomicConstraints<Scalar<P>>& c, const Scalar<P>& t,
                                     const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n();
    const In<T> q(z.data(), n);
    if (value_of(h) != value_of(w.last_h)) w.forget_multipliers();
    w.expect_multipliers();
    const T kick = w.first * h, length = w.drift * h;
    c.apply_transpose(w.multiplier, w.reaction);
    for (std::size_t k = 0; k < n; ++k) {
      w.impulse[k] = kick * w.force[k] - w.reaction[k];
      w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
    }
    c.velocity(t, q, w.momentum, w.velocity);
    Largest<T> positions;
    for (std::size_t k = 0; k < n; ++k) {
      w.displacement[k] = length * w.velocity[k];
      w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
      positions.add(w.position[k]);
    }
    const T reference = positions.get();
    for (T& x : w.correction) x = T(0);
    Convergence<T> convergence;
    bool settled = false;
    do {
      c.values(t + h, w.position, w.residual);
      c.solve(w.residual, w.residual);
      const T moved = w.linear ? move<P>(c, z, w) : kick_back<P>(c, t, length, z, w);
      convergence.begin_iteration();
      convergence.add(moved, reference, reference);
      ++p.counters().iterations;
      // The next correction would be below the rounding of phi.
      const Value<T> ratio = convergence.iterations() == 1 ? w.expected_contraction() : convergence.ratio();
      settled = ratio < Value<T>(0.1) &&
                ratio * relative_size(moved, reference, reference) <= unit_roundoff<T>() / 8;
    } while (!convergence.finished(50) && !settled);
    w.watch(convergence);
    // Iterates that grow beyond all numbers are those of a step that is too large.
    if (!settled && convergence.status() != Status::converged) return Status::not_converged;
    const T per_length = T(1) / length;
    for (std::size_t i = 0; i < w.multiplier.size(); ++i) {
      w.correction[i] = w.correction[i] * per_length;
      w.multiplier[i] = w.multiplier[i] + w.correction[i];
    }
    c.apply_transpose(w.correction, w.reaction);
    for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] - w.reaction[k];
    if (!w.linear)  // then S depends on the momenta
      for (std::size_t k = 0; k < n; ++k) w.momentum[k] = z[n + k] + (w.impulse[k] + w.carry[n + k]);
    return Status::converged;
  }

  // A correction of the positions by the solution in `residual`; returns the largest. Where H_p is linear it
  // is H_pp B^T times that.
  template <class P, class T = Scalar<P>>
  static T move(HolonomicConstraints<T>& c, const State<P>& z, Work<P>& w) {
    c.hidden_by_momentum_transpose(w.residual, w.reaction);
    for (std::size_t i = 0; i < w.residual.size(); ++i) w.correction[i] = w.correction[i] + w.residual[i];
    Largest<T> largest;
    for (std::size_t k = 0; k < w.n(); ++k) {
      largest.add(w.reaction[k]);
      w.displacement[k] = w.displacement[k] - w.reaction[k];
      w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
    }
    return largest.get();
  }
  // Elsewhere what the change of p' makes of it.
  template <class P, class T = Scalar<P>>
  static T kick_back(HolonomicConstraints<T>& c, const T& t, const T& length, const State<P>& z, Work<P>& w) {
    const std::size_t n = w.n();
    for (std::size_t i = 0; i < w.residual.size(); ++i) {
      w.correction[i] = w.correction[i] + w.residual[i];
      w.residual[i] = w.correction[i] / length;
    }
    c.apply_transpose(w.residual, w.reaction);
    for (std::size_t k = 0; k < n; ++k)
      w.momentum[k] = z[n + k] + ((w.impulse[k] - w.reaction[k]) + w.carry[n + k]);
    c.velocity(t, In<T>(z.data(), n), w.momentum, w.velocity);
    Largest<T> largest;
    for (std::size_t k = 0; k < n; ++k) {
      const T displacement = length * w.velocity[k];
      largest.add(displacement - w.displacement[k]);
      w.displacement[k] = displacement;
      w.position[k] = z[k] + (displacement + w.carry[k]);
    }
    return largest.get();
  }

  // p1: adds the second kick, without its normal part, to the impulse.
  template <class P>
  static Status kick_onto_momenta(const P& p, HolonomicConstraints<Scalar<P>>& c, const Scalar<P>& t,
                                  const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n();
    ++p.counters().factorisations;
    if (const Status status = c.linearise(t, w.position, w.momentum); status != Status::converged)
      return status;
    ++p.counters().fields;
    c.force(t, w.position, w.momentum, w.force);
    const T kick = w.last * h;
    for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] + kick * w.force[k];
    return w.onto_hidden(c, t, w.position, In<T>(z.data() + n, n), In<T>(w.carry).subspan(n), w.impulse,
                         w.momentum, w.linear);
  }
};

}  // namespace pfaff
