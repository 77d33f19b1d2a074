// RATTLE for H = T(p, t) + V(q, t) with constraints phi(q, t) = 0, B = dphi/dq:
//
//   p' = p0 + h/2 (-V_q(q0, t0)) - B(q0)^T nu,  q1 = q0 + h T_p(p', t0 + h/2),  phi(q1, t1) = 0
//   p1 = p' + h/2 (-V_q(q1, t1)) - B(q1)^T mu,                                  phi~(q1, p1, t1) = 0
//
// (hairer-lubich-wanner2006 VII.1.4): order 2, symmetric, symplectic on the constraint surface, one force a
// step. Both levels of constraints hold to round-off after every step.
//
// The multipliers nu are extrapolated from those of the steps before and corrected by Newton's method with
// the matrix S = B H_pp B^T at q0. Its factors are known already, since the momenta at the end of the step
// before needed them, so that a step factors once.
//
// Newton's method stops when its next correction would be lost in the rounding of phi. To tell this after one
// correction it has to know the contraction, the ratio of one correction to the one before, and takes it from
// an earlier step. But extrapolated multipliers are so good that one correction is enough, and one correction
// shows no ratio. Therefore every sixteenth step starts from the plain multipliers of the step before: it
// needs a second correction, and measures the contraction for the fifteen that follow. Where coordinates are
// of very different sizes, the small ones are corrected until rounding lets their corrections become no
// smaller; how large they are then is remembered for as many steps, which do not make corrections in vain to
// see it.
//
// The update is compensated.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/integrators/constrained/constrained_verlet.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>
#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>
#include <pfaff/integrators/support/remembered_contraction.hpp>

namespace pfaff {

/// Half a kick, a drift onto phi = 0, half a kick onto phi~ = 0.
struct Rattle : ConstrainedVerlet {
  static std::vector<Parameter> parameters() {
    return {
        parameter(static_cast<bool Rattle::*>(&Rattle::compensated), "compensated", "compensated summation")};
  }

  template <class P>
  struct Work : ConstrainedVerlet::Work<P> {
    using T = Scalar<P>;
    using Sums = ConstrainedVerlet::Work<P>;
    using Sums::carry, Sums::force, Sums::position, Sums::n;
    static constexpr int oldest_contraction = 16;
    bool linear;                        // H_p is linear in p
    bool steady;                        // H_p does not depend on time
    std::vector<T> velocity, reaction;  // of the n positions
    std::vector<T> multiplier, residual, correction;
    DifferencePredictor<T, dynamic, dynamic> predictor;
    MomentumProjection<T> onto_hidden;
    Continuation<P> continuation;  // the state at which the constraints are placed and the force is known
    T last_h{0};
    RememberedContraction<Value<T>> contraction;  // of Newton's method, from the last step that measured it
    int age = 0;                                  // steps since then
    Value<T> floor{0};  // what corrections of small coordinates came to in the last step that saw it,
    int floor_age = 0;  // and the steps since then

    Work(const Rattle& method, const P& p)
        : Sums(method, p),
          velocity(n()),
          reaction(n()),
          multiplier(p.holonomic().count()),
          residual(multiplier.size()),
          correction(multiplier.size()),
          predictor(multiplier.size(), static_cast<std::size_t>(difference_levels<T>)),
          onto_hidden(p.holonomic()),
          continuation(p) {
      linear = velocity_is_linear<T>(p.holonomic(), generic_time<T>(), generic_positions<T>(n()));
      steady = velocity_is_steady<T>(p.holonomic());
    }

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
      contraction.forget();
      floor = Value<T>(0);
    }
    /// The multipliers to start from: extrapolated ones or, where the contraction has to be measured, those
    /// of the step before.
    void expect_multipliers() {
      const bool measure = !contraction.known() || ++age >= oldest_contraction;
      for (std::size_t i = 0; i < multiplier.size(); ++i)
        multiplier[i] = measure ? predictor.latest(i) : predictor.expected(i);
    }
    void remember_contraction(const CoordinateConvergence<T>& convergence) {
      if (contraction.remember_last(convergence.contraction())) age = 0;
      if (convergence.floor() > Value<T>(0)) floor = convergence.floor(), floor_age = 0;
    }
    /// What is known of the rounding of small coordinates; 0 where it is to be seen anew.
    [[nodiscard]] Value<T> expected_floor() { return ++floor_age < oldest_contraction ? floor : Value<T>(0); }
    /// The contraction to be expected, with a factor of 2 to spare; 1 where it is not known, or is too old.
    [[nodiscard]] Value<T> expected_contraction() const {
      const bool usable = contraction.known() && age < oldest_contraction;
      return usable ? Value<T>(2) * contraction.ratio() : Value<T>(1);
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
    PositionConstraints<Scalar<P>>& c = p.holonomic();
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
    add_changes(z, w);
    w.predictor.remember([&w](std::size_t k) { return w.multiplier[k]; });
    w.last_h = h;
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

  // Places the constraints and evaluates the force at the start of the step, unless the step before ended
  // here and has done so already.
  template <class P>
  static Status start(const P& p, PositionConstraints<Scalar<P>>& c, const Scalar<P>& t, const Scalar<P>& h,
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
  static Status drift_onto_positions(const P& p, PositionConstraints<Scalar<P>>& c, const Scalar<P>& t,
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
    const T middle = t + kick;  // the time of T that the kick has reached
    c.velocity(middle, q, w.momentum, w.velocity);
    CoordinateConvergence<T> convergence;
    convergence.expect(w.expected_floor(), w.expected_contraction());
    VectorCorrections<T> moved(convergence.each());
    for (std::size_t k = 0; k < n; ++k) {
      w.displacement[k] = length * w.velocity[k];
      w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
      moved.against(w.position[k]);
    }
    for (T& x : w.correction) x = T(0);
    do {
      c.values(t + h, w.position, w.residual);
      c.solve(w.residual, w.residual);
      convergence.kick(w.residual);
      moved.next(convergence.each());
      if (w.linear && w.steady) {
        move<P>(c, z, w, moved);
      } else {
        kick_back<P>(c, middle, length, z, w, moved);
      }
      convergence.begin_iteration();
      convergence.add(moved);
      ++p.counters().iterations;
      // Settled where the next correction, this one times the contraction, would be lost in the rounding of
      // phi.
      const Value<T> ratio = convergence.iterations() == 1 ? w.expected_contraction() : convergence.ratio();
      if (ratio < Value<T>(0.1) && ratio * convergence.size() <= unit_roundoff<T>() / 8) convergence.settle();
    } while (!convergence.finished(50));
    w.remember_contraction(convergence);
    // Iterates that overflow come from a step that is too large, and are reported as not converged, too.
    if (convergence.status() != Status::converged) return Status::not_converged;
    const T per_length = T(1) / length;
    for (std::size_t i = 0; i < w.multiplier.size(); ++i) {
      w.correction[i] = w.correction[i] * per_length;
      w.multiplier[i] = w.multiplier[i] + w.correction[i];
    }
    c.apply_transpose(w.correction, w.reaction);
    for (std::size_t k = 0; k < n; ++k) w.impulse[k] = w.impulse[k] - w.reaction[k];
    if (!w.linear)  // then S depends on the momenta
      w.place_momenta(z);
    return Status::converged;
  }

  // Corrects the positions where H_p is linear in p and steady, so that H_pp is that of the point where the
  // constraints are placed: by H_pp B^T times the solution x of S x = phi, which stands in `residual`.
  template <class P, class T = Scalar<P>>
  static void move(PositionConstraints<T>& c, const State<P>& z, Work<P>& w, VectorCorrections<T>& moved) {
    c.hidden_by_momentum_transpose(w.residual, w.reaction);
    for (std::size_t i = 0; i < w.residual.size(); ++i) w.correction[i] = w.correction[i] + w.residual[i];
    for (std::size_t k = 0; k < w.n(); ++k) {
      w.displacement[k] = w.displacement[k] - w.reaction[k];
      w.position[k] = z[k] + (w.displacement[k] + w.carry[k]);
      moved.add(w.reaction[k], w.position[k], w.displacement[k]);
    }
  }
  // Corrects the positions where H_p is anything else: the multipliers change p', and the positions follow
  // from a new drift with H_p at this p' and the time `middle`.
  template <class P, class T = Scalar<P>>
  static void kick_back(PositionConstraints<T>& c, const T& middle, const T& length, const State<P>& z,
                        Work<P>& w, VectorCorrections<T>& moved) {
    const std::size_t n = w.n();
    for (std::size_t i = 0; i < w.residual.size(); ++i) {
      w.correction[i] = w.correction[i] + w.residual[i];
      w.residual[i] = w.correction[i] / length;
    }
    c.apply_transpose(w.residual, w.reaction);
    for (std::size_t k = 0; k < n; ++k)
      w.momentum[k] = z[n + k] + ((w.impulse[k] - w.reaction[k]) + w.carry[n + k]);
    c.velocity(middle, In<T>(z.data(), n), w.momentum, w.velocity);
    for (std::size_t k = 0; k < n; ++k) {
      const T displacement = length * w.velocity[k], before = w.displacement[k];
      w.displacement[k] = displacement;
      w.position[k] = z[k] + (displacement + w.carry[k]);
      moved.add(displacement - before, w.position[k], displacement);
    }
  }

  // Finds p1: adds to the impulse the second kick, projected onto the hidden constraints.
  template <class P>
  static Status kick_onto_momenta(const P& p, PositionConstraints<Scalar<P>>& c, const Scalar<P>& t,
                                  const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    const std::size_t n = w.n();
    ++p.counters().factorisations;
    if (const Status status = place_at_end(p, t, w); status != Status::converged) return status;
    ++p.counters().fields;
    w.kick(w.last * h);
    return w.onto_hidden(c, t, w.position, In<Scalar<P>>(z.data() + n, n), In<Scalar<P>>(w.carry).subspan(n),
                         w.impulse, w.momentum, w.linear);
  }
};

}  // namespace pfaff
