// What methods share whose momenta are reflected by velocity constraints: GNI and the nonholonomic leap-frog.
//
// Such a method arrives at q_k with a momentum p^- that has not felt the constraints there, and leaves with
// p^+, its mirror image: half their sum lies on psi(q_k, p) = 0, half their difference along A(q_k)^T.
//
//   p = p^- + r,   p^+ = p + r,   r = -A(q_k)^T mu,   psi(q_k, p, t_k) = 0
//
// A run sees p, which satisfies the constraints; r is carried from step to step beside it. r is the step
// times a reaction, so that it is scaled where the step changes. A step of -h then leaves with p^-, and goes
// back the way that the step of h came. Where the motion is reversed, p -> -p, p^+ and -p^- change places,
// and r stays what it was; therefore it is kept as long as positions are, whatever becomes of p. A state at
// other positions than those of the last step starts with p^- = p, without a reaction: the error of this
// start does not add up and leaves the order 2 alone.
//
// These methods cannot be composed: r depends on the step, and sub-steps of different sizes leave an error of
// order h^2 (compositions of any weights were measured to have order 2).
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/facets/claims.hpp>
#include <pfaff/core/facets/linear_reversal.hpp>
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace pfaff {

/// What these methods have in common: the ways to the middle and to the end, the reflected momentum, and the
/// projection with which a step ends.
struct ReflectedMomentum {
  /// The ways from the start to the middle and from there to the end, in units of the step.
  std::array<Quad, 2> halves{Quad(1) / Quad(2), Quad(1) / Quad(2)};
  bool compensated = true;

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  std::span<Quad> coefficients() { return halves; }
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const {
    std::vector<Claim> kept{Claim::symmetric, Claim::velocity_constraints, Claim::nonholonomic_momentum};
    if (linear_reversal(model, true)) kept.push_back(Claim::reversible);
    return kept;
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T first, second;          // the halves
    std::vector<T> carry;     // what the sums of q and p have rounded off
    std::vector<T> reaction;  // r
    // The changes of q and p since the start of the step, and q and p with these changes added.
    std::vector<T> displacement, impulse, position, momentum;
    MomentumProjection<T> onto_velocities;
    bool linear;  // H_p is linear in p

    Work(const ReflectedMomentum& method, const P& p)
        : first(Real(method.halves[0])),
          second(Real(method.halves[1])),
          carry(p.size()),
          reaction(n()),
          displacement(n()),
          impulse(n()),
          position(n()),
          momentum(n()),
          onto_velocities(p.nonholonomic()),
          end_(n()) {
      linear = velocity_is_linear<T>(p.nonholonomic(), generic_time<T>(), generic_positions<T>(n()));
    }
    [[nodiscard]] std::size_t n() const { return carry.size() / 2; }
    /// True where the last step ended at these positions at t.
    [[nodiscard]] bool continues(const T& t, const T& h, const State<P>& z) const {
      if (!known_ || abs(value_of(t - t_)) > abs(value_of(h)) * Value<T>(1e-6)) return false;
      bool same = true;
      for (std::size_t k = 0; k < n(); ++k) same = identical(z[k], end_[k]) && same;
      return same;
    }
    /// The ratio of this step to the last one, where this one continues it.
    [[nodiscard]] T growth(const T& h) const { return h / last_h_; }
    void remember(const T& t, const T& h, const State<P>& z) {
      std::copy(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n()), end_.begin());
      t_ = t;
      last_h_ = h;
      known_ = true;
    }
    void forget() { known_ = false; }

   private:
    std::vector<T> end_;  // the positions where the last step ended
    T t_{0}, last_h_{0};
    bool known_ = false;
  };

 protected:
  // Fills `impulse` with p^+ - p0 of the step's start, where p0 is the momentum of the state z.
  template <class P>
  static Status leave(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n();
    if (w.continues(t, h, z)) {
      const T growth = w.growth(h);
      for (std::size_t k = 0; k < n; ++k) w.impulse[k] = growth * w.reaction[k];
      return Status::converged;
    }
    VelocityConstraints<T>& c = p.nonholonomic();
    const In<T> q0(z.data(), n), p0(z.data() + n, n);
    for (T& x : w.carry) x = T(0);
    for (T& x : w.impulse) x = T(0);
    ++p.counters().factorisations;
    if (const Status status = c.linearise(t, q0, p0); status != Status::converged) return status;
    if (const Status status =
            w.onto_velocities(c, t, q0, p0, In<T>(w.carry).subspan(n), w.impulse, w.momentum, w.linear);
        status != Status::converged)
      return status;
    for (T& x : w.impulse) x = x + x;
    return Status::converged;
  }

  // Ends the step at `position`: `impulse` is p^- - p0 there and becomes p - p0, and r is what it changes by.
  template <class P>
  Status arrive(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    VelocityConstraints<T>& c = p.nonholonomic();
    const std::size_t n = w.n();
    const In<T> p0(z.data() + n, n), p_carry(w.carry.data() + n, n);
    for (std::size_t k = 0; k < n; ++k) {
      w.momentum[k] = p0[k] + (w.impulse[k] + p_carry[k]);
      w.reaction[k] = w.impulse[k];
    }
    ++p.counters().factorisations;
    if (const Status status = c.linearise(t + h, w.position, w.momentum); status != Status::converged)
      return status;
    if (const Status status =
            w.onto_velocities(c, t + h, w.position, p0, p_carry, w.impulse, w.momentum, w.linear);
        status != Status::converged)
      return status;
    for (std::size_t k = 0; k < n; ++k) {
      w.reaction[k] = w.impulse[k] - w.reaction[k];
      add_to(z[k], w.carry[k], w.displacement[k], compensated);
      add_to(z[n + k], w.carry[n + k], w.impulse[k], compensated);
    }
    w.remember(t + h, h, z);
    return Status::converged;
  }
};

}  // namespace pfaff
