// What the Stoermer-Verlet methods on a constraint surface share: half a kick, a drift and half a kick,
//
//   p' = p0 + h/2 (-V_q(q0, t0)) + reactions,   q1 = q0 + h T_p(p', t0 + h/2) + reactions,
//   p1 = p' + h/2 (-V_q(q1, t1)) + reactions
//
// (hairer-lubich-wanner2006 VII.1.4). RATTLE, SHAKE and LINCS differ in how they find the reactions and in
// what these are to satisfy. All of them gather the changes of q and p over the step, displacement and
// impulse, and add them to the state once, at its end, with compensated summation.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/solve/summation.hpp>

namespace pfaff {

/// What these methods have in common: the lengths of kicks and drift, the changes that a step adds to the
/// state, and the systems they refuse.
struct ConstrainedVerlet {
  /// The kick, the drift and the kick, in units of the step.
  std::array<Quad, 3> lengths{Quad(1) / Quad(2), Quad(1), Quad(1) / Quad(2)};
  bool compensated = true;

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  std::span<Quad> coefficients() { return lengths; }

  /// The energy has to be H = T(p, t) + V(q, t), without friction.
  [[nodiscard]] std::string refuses(const Model& model) const {
    if (!model.separable_energy())
      return "needs a constrained H = T(p, t) + V(q, t); the Hamiltonian of " + model.name() +
             " is not written as kinetic and potential energy";
    if (!model.frictionless())
      return "keeps energies and needs a system without friction; " + model.name() + " has friction";
    return {};
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    T first, drift, last;  // the lengths
    std::vector<T> carry;  // what the sums of q and p have rounded off
    // n numbers each: the force, the changes of p and of q since the start of the step, and p and q with
    // these changes added.
    std::vector<T> force, impulse, displacement, momentum, position;

    Work(const ConstrainedVerlet& method, const P& p)
        : first(Real(method.lengths[0])),
          drift(Real(method.lengths[1])),
          last(Real(method.lengths[2])),
          carry(p.size()),
          force(n()),
          impulse(n()),
          displacement(n()),
          momentum(n()),
          position(n()) {}
    [[nodiscard]] std::size_t n() const { return carry.size() / 2; }
    /// position = q + displacement, z = (q, p).
    void place_positions(const State<P>& z) {
      const std::size_t half = n();
      for (std::size_t k = 0; k < half; ++k) position[k] = z[k] + (displacement[k] + carry[k]);
    }
    /// momentum = p + impulse.
    void place_momenta(const State<P>& z) {
      const std::size_t half = n();
      for (std::size_t k = 0; k < half; ++k) momentum[k] = z[half + k] + (impulse[k] + carry[half + k]);
    }
    /// impulse = impulse + length * force.
    void kick(const T& length) {
      const std::size_t half = n();
      for (std::size_t k = 0; k < half; ++k) impulse[k] = impulse[k] + length * force[k];
    }
  };

 protected:
  /// Places the constraints at the end of the drift, (t, q1), and evaluates the force there.
  template <class P>
  static Status place_at_end(const P& p, const Scalar<P>& t, Work<P>& w) {
    PositionConstraints<Scalar<P>>& c = p.holonomic();
    if (const Status status = c.linearise(t, w.position, w.momentum); status != Status::converged)
      return status;
    c.force(t, w.position, w.momentum, w.force);
    return Status::converged;
  }
  /// Ends a step: adds displacement and impulse to z = (q, p).
  template <class P>
  void add_changes(State<P>& z, Work<P>& w) const {
    const std::size_t n = w.n();
    for (std::size_t k = 0; k < n; ++k) {
      add_to(z[k], w.carry[k], w.displacement[k], compensated);
      add_to(z[n + k], w.carry[n + k], w.impulse[k], compensated);
    }
  }
};

}  // namespace pfaff
