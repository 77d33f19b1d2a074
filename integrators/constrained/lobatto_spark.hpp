// The Lobatto IIIA-IIIB pair for H(q, p, t) with constraints phi(q, t) = 0, B = dphi/dq:
//
//   Q_i = q0 + h sum_j a_ij H_p(Q_j, P_j),   P_i = p0 + h sum_j a^_ij (-H_q(Q_j, P_j) - B(Q_j)^T L_j),
//   phi(Q_i) = 0,   q1 = Q_s,   p1 = p0 + h sum_j b_j (-H_q(Q_j, P_j) - B(Q_j)^T L_j),   phi~(q1, p1) = 0
//
// (jay1996; hairer-lubich-wanner2006 VII.1.5): order 2 s - 2, symmetric, symplectic on the constraint
// surface; with s = 2 and H = T(p) + V(q, t) it is RATTLE. Any mass matrix M(q), no friction.
//
// The last column of IIIB is zero, so that L_s stands in p1 alone, where the hidden constraints determine it.
// Everything else is iterated to round-off: the stages by fixed-point iteration from extrapolated slopes, the
// multipliers by a simplified Newton method. In place of the products B(Q_i) H_pp B(Q_j)^T its matrix has S
// at q0, so that an iteration solves with S once for each stage. Where the mass matrix depends on the
// positions, the multipliers lag an iteration behind these, and corrections stall and shrink in turns. The
// positions are at last those to which the velocities of the last momenta lead, so that both halves of the
// update are made of the same rates; their projections onto the constraints, which are down to round-off by
// then, would bias the energy. The update is compensated.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>
#include <pfaff/integrators/constrained/lobatto_stages.hpp>

namespace pfaff {

/// The Lobatto IIIA-IIIB pair on the constraint surface.
struct LobattoSpark {
  int stages = 3;
  bool compensated = true;
  LobattoCoefficients tableau = lobatto_coefficients(3);

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  static std::vector<Parameter> parameters() {
    return {parameter(&LobattoSpark::stages, "stages", "", 2, 16, "number of stages s; the order is 2 s - 2"),
            parameter(&LobattoSpark::compensated, "compensated", "compensated summation")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list;
    for (int s = 2; s <= (full ? 6 : 5); ++s) list.push_back({{"stages", std::to_string(s)}});
    return list;
  }
  void validate() { tableau = lobatto_coefficients(stages); }
  [[nodiscard]] int order(const Model& /*model*/) const { return 2 * stages - 2; }
  /// The weights b of the momenta.
  std::span<Quad> coefficients() { return tableau.weights; }
  [[nodiscard]] std::string refuses(const Model& model) const {
    if (!model.frictionless())
      return "keeps energies and needs a system without friction; " + model.name() + " has friction";
    return {};
  }

  template <class P>
  struct Work : LobattoStages<Scalar<P>> {
    using T = Scalar<P>;
    std::vector<T> to_multipliers;
    // The constraints, placed at each stage, because every iteration needs the B(Q_i) of all stages. The
    // first are placed at q0.
    std::vector<std::unique_ptr<PositionConstraints<T>>> at;
    std::vector<T> solution;  // [stage][constraint]
    MomentumProjection<T> onto_hidden;

    Work(const LobattoSpark& method, const P& p)
        : LobattoStages<T>(method.tableau, p.size() / 2, p.holonomic().count()),
          to_multipliers(this->converted(method.tableau.multipliers)),
          solution(this->multiplier.size()),
          onto_hidden(p.holonomic()) {
      for (std::size_t i = 0; i < this->s(); ++i)
        at.push_back(p.model()->template holonomic_constraints<T>());
    }
  };

  template <HasHolonomic P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    Status status = solve_stages(p, t, h, z, w);
    if (status == Status::converged) status = end_momentum(p, t, h, z, w);
    return w.take(status, h, z, compensated);
  }

 private:
  // Finds the stages Q and P, and in `move` the change from q0 to q1.
  template <class P>
  static Status solve_stages(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z,
                             Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n(), s = w.s();
    if (const Status status = w.begin(p, *w.at[0], t, h, z); status != Status::converged) return status;
    for (std::size_t k = 0; k < n; ++k) w.position[k] = z[k] + w.carry[k];
    CoordinateConvergence<T> convergence(Corrections::in_turns);
    bool first = true;
    do {
      VectorCorrections<T> moved(convergence.each());
      set_momenta<P>(h, z, w);
      if (first)
        for (std::size_t i = 1; i < s; ++i)
          for (std::size_t k = 0; k < n; ++k)
            w.position[i * n + k] = z[k] + (w.displacement(h, i, k) + w.carry[k]);
      set_velocities<P>(t, h, w);
      // Q_i, moved onto phi = 0 with the multipliers that do so.
      for (std::size_t i = 1; i < s; ++i) {
        for (std::size_t k = 0; k < n; ++k) {
          w.move[k] = w.displacement(h, i, k);
          w.end[k] = z[k] + (w.move[k] + w.carry[k]);
        }
        const Out<T> solution = w.constraint(w.solution, i - 1);
        w.at[0]->values(t + w.c[i] * h, w.end, solution);
        w.at[0]->solve(solution, solution);
        convergence.kick(solution);
        w.at[0]->hidden_by_momentum_transpose(solution, w.impulse);
        for (std::size_t k = 0; k < n; ++k) {
          w.move[k] = w.move[k] - w.impulse[k];
          const T next = z[k] + (w.move[k] + w.carry[k]);
          moved.against(next);
          moved.add(next - w.position[i * n + k], next, w.move[k]);
          w.position[i * n + k] = next;
        }
      }
      if (const Status status = react(p, t, h, w); status != Status::converged) return status;
      convergence.begin_iteration();
      convergence.add(moved);
      ++p.counters().iterations;
      first = false;
    } while (!convergence.finished(100));
    set_momenta<P>(h, z, w);
    set_velocities<P>(t, h, w);
    for (std::size_t k = 0; k < n; ++k) {
      w.move[k] = w.displacement(h, s - 1, k);
      w.position[(s - 1) * n + k] = z[k] + (w.move[k] + w.carry[k]);
    }
    // Iterates that overflow come from a step that is too large, and are reported as not converged, too.
    return convergence.status() == Status::converged ? Status::converged : Status::not_converged;
  }

  // P_i, into which L_s and the force of the last stage do not enter.
  template <class P>
  static void set_momenta(const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    for (std::size_t i = 0; i < w.s(); ++i)
      for (std::size_t k = 0; k < w.n(); ++k) w.momentum[i * w.n() + k] = w.momentum_of(h, z, i, k);
  }
  template <class P>
  static void set_velocities(const Scalar<P>& t, const Scalar<P>& h, Work<P>& w) {
    for (std::size_t i = 0; i < w.s(); ++i)
      w.at[0]->velocity(t + w.c[i] * h, w.stage(w.position, i), w.stage(w.momentum, i),
                        w.stage(w.velocity, i));
  }

  // Corrects the multipliers L_1 ... L_{s-1} and fills the forces with their reactions.
  template <class P>
  static Status react(const P& p, const Scalar<P>& t, const Scalar<P>& h, Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n(), s = w.s(), count = w.count();
    const T scale = T(1) / (h * h);
    for (std::size_t j = 0; j + 1 < s; ++j) {
      const Out<T> multiplier = w.constraint(w.multiplier, j), force = w.stage(w.force, j);
      for (std::size_t c = 0; c < count; ++c)
        for (std::size_t i = 0; i + 1 < s; ++i)
          multiplier[c] =
              multiplier[c] + scale * w.to_multipliers[j * (s - 1) + i] * w.solution[i * count + c];
      const T time = t + w.c[j] * h;
      if (j > 0) {
        ++p.counters().factorisations;
        if (const Status status = w.at[j]->linearise(time, w.stage(w.position, j), w.stage(w.momentum, j));
            status != Status::converged)
          return status;
      }
      w.at[j]->apply_transpose(multiplier, w.impulse);
      ++p.counters().fields;
      w.at[j]->force(time, w.stage(w.position, j), w.stage(w.momentum, j), force);
      for (std::size_t k = 0; k < n; ++k) force[k] = force[k] - w.impulse[k];
    }
    return Status::converged;
  }

  // Finds, in `impulse`, the change from p0 to p1.
  template <class P>
  static Status end_momentum(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z,
                             Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n(), s = w.s();
    PositionConstraints<T>& last = *w.at[s - 1];
    if (const Status status = w.push_to_end(p, last, t, h); status != Status::converged) return status;
    return w.onto_hidden(last, t + h, w.stage(w.position, s - 1), In<T>(z.data() + n, n),
                         In<T>(w.carry).subspan(n), w.impulse, w.end, false);
  }
};

}  // namespace pfaff
