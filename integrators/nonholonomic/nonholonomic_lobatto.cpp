// The Lobatto IIIA-IIIB pair for H(q, p, t) with constraints psi(q, p, t) = A(q, t) v + b(q, t) = 0 of the
// velocities v = H_p:
//
//   Q_i = q0 + h sum_j a_ij H_p(Q_j, P_j),   P_i = p0 + h sum_j a^_ij (-H_q(Q_j, P_j) - A(Q_j)^T L_j),
//   sum_i b_i c_i^(k - 1) psi(Q_i, P_i) = 0 for k = 1 ... s - 1,
//   q1 = Q_s,   p1 = p0 + h sum_j b_j (-H_q(Q_j, P_j) - A(Q_j)^T L_j),   psi(q1, p1) = 0
//
// (the family of jay1998). The last column of IIIB is zero, so that L_s stands in p1 alone, where psi(q1, p1)
// = 0 determines it, and s - 1 conditions are left for the other L_j. psi = 0 in every stage would be one too
// many; the weighted means are as many as they have to be, and treat both ends of the step alike.
//
// Order 2 s - 2. Symmetric, and so reversible; psi = 0 holds to round-off at the ends of steps. Momenta along
// symmetries that the constraints allow are kept where these are linear in q, because the pair keeps bilinear
// forms of q and p and the reactions do no work along them. No energy is kept, nor any symplectic structure,
// which nonholonomic motion itself does not keep. Holonomic constraints that stand beside are kept at the
// level of velocities.
//
// All stages are iterated to round-off from what is extrapolated from past steps, the multipliers by a
// simplified Newton method: in place of A(Q_i) H_pp A(Q_j)^T it has S at q0. The update is compensated.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/method_alias.hpp>
#include <pfaff/integrators/constrained/constraint_solves.hpp>
#include <pfaff/integrators/constrained/lobatto_stages.hpp>
#include <pfaff/integrators/nonholonomic/energy_slopes.hpp>

namespace {
using namespace pfaff;

struct NonholonomicLobatto {
  int stages = 3;
  bool compensated = true;
  LobattoCoefficients tableau = lobatto_coefficients(3);

  static constexpr bool fixed_sizes = false;  // the work is in batched calls, which take no fixed size

  static std::vector<Parameter> parameters() {
    return {parameter(&NonholonomicLobatto::stages, "stages", "", 2, 4,
                      "number of stages s; the order is 2 s - 2"),
            parameter(&NonholonomicLobatto::compensated, "compensated", "compensated summation")};
  }
  static std::vector<Assignments> instances(bool full) {
    if (!full) return {{{"stages", "3"}}};
    return {{{"stages", "2"}}, {{"stages", "3"}}, {{"stages", "4"}}};
  }
  void validate() { tableau = lobatto_coefficients(stages); }
  [[nodiscard]] int order(const Model& /*model*/) const { return 2 * stages - 2; }
  /// The weights b of the momenta.
  std::span<Quad> coefficients() { return tableau.weights; }

  template <class P>
  struct Work : LobattoStages<Scalar<P>> {
    using T = Scalar<P>;
    std::vector<T> to_multipliers;  // from psi in all stages to corrections of the multipliers
    // The constraints, placed at each stage, because every iteration needs the A(Q_i) of all stages. The
    // first are placed at q0.
    std::vector<std::unique_ptr<VelocityConstraints<T>>> at;
    std::vector<T> residual, correction;  // psi of all stages; of one multiplier
    EnergySlopes<T> slopes;
    MomentumProjection<T> onto_velocities;

    Work(const NonholonomicLobatto& method, const P& p)
        : LobattoStages<T>(method.tableau, p.size() / 2, p.nonholonomic().count()),
          to_multipliers(this->converted(velocity_multipliers(lobatto_coefficients(method.stages)))),
          residual(this->s() * this->count()),
          correction(this->count()),
          slopes(p.model()),
          onto_velocities(p.nonholonomic()) {
      for (std::size_t i = 0; i < this->s(); ++i) at.push_back(p.model()->template velocity_constraints<T>());
    }
  };

  template <HasVelocityConstraints P>
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
    for (std::size_t i = 0; i < s; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        w.position[i * n + k] = z[k] + (w.displacement(h, i, k) + w.carry[k]);
        w.momentum[i * n + k] = w.momentum_of(h, z, i, k);
      }
    CoordinateConvergence<T> convergence(Corrections::uneven);
    do {
      VectorCorrections<T> moved(convergence.each()), kicked(convergence.each());
      move_stages(p, t, h, z, w, moved);
      if (const Status status = push_stages(p, t, h, w); status != Status::converged) return status;
      react(t, h, z, w);
      for (std::size_t i = 0; i < s; ++i)
        for (std::size_t k = 0; k < n; ++k) {
          const T next = w.momentum_of(h, z, i, k);
          kicked.against(next);
          kicked.against(z[n + k]);
          kicked.add(next - w.momentum[i * n + k], next, next - z[n + k]);
          w.momentum[i * n + k] = next;
        }
      convergence.begin_iteration();
      convergence.add(moved);
      convergence.add(kicked);
      ++p.counters().iterations;
    } while (!convergence.finished(100));
    // Iterates that overflow come from a step that is too large, and are reported as not converged, too.
    return convergence.status() == Status::converged ? Status::converged : Status::not_converged;
  }

  // Velocities at the stages, and the Q_i to which they lead.
  template <class P, class T = Scalar<P>>
  static void move_stages(const P& p, const T& t, const T& h, const State<P>& z, Work<P>& w,
                          VectorCorrections<T>& moved) {
    const std::size_t n = w.n(), s = w.s();
    for (std::size_t i = 0; i < s; ++i) {
      const T time = t + w.c[i] * h;
      ++p.counters().fields;
      if (w.slopes.separable()) {
        w.slopes.velocity(time, w.stage(w.momentum, i), w.stage(w.velocity, i));
      } else {
        w.slopes(time, w.stage(w.position, i), w.stage(w.momentum, i), w.stage(w.velocity, i),
                 w.stage(w.force, i));
      }
    }
    for (std::size_t i = 1; i < s; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        w.move[k] = w.displacement(h, i, k);
        const T next = z[k] + (w.move[k] + w.carry[k]);
        moved.against(next);
        moved.add(next - w.position[i * n + k], next, w.move[k]);
        w.position[i * n + k] = next;
      }
  }

  // Forces at the new Q_i with the reactions of the multipliers as they are.
  template <class P, class T = Scalar<P>>
  static Status push_stages(const P& p, const T& t, const T& h, Work<P>& w) {
    const std::size_t n = w.n(), s = w.s();
    for (std::size_t j = 0; j + 1 < s; ++j) {
      const T time = t + w.c[j] * h;
      const Out<T> force = w.stage(w.force, j);
      if (j > 0) {
        ++p.counters().factorisations;
        if (const Status status = w.at[j]->linearise(time, w.stage(w.position, j), w.stage(w.momentum, j));
            status != Status::converged)
          return status;
      }
      if (w.slopes.separable()) w.slopes.force(time, w.stage(w.position, j), force);
      w.at[j]->apply_transpose(w.constraint(w.multiplier, j), w.impulse);
      for (std::size_t k = 0; k < n; ++k) force[k] = force[k] - w.impulse[k];
    }
    return Status::converged;
  }

  // Corrects the multipliers, and with them the forces.
  template <class P, class T = Scalar<P>>
  static void react(const T& t, const T& h, const State<P>& z, Work<P>& w) {
    const std::size_t n = w.n(), s = w.s(), count = w.count();
    for (std::size_t i = 0; i < s; ++i) {
      for (std::size_t k = 0; k < n; ++k) w.end[k] = w.momentum_of(h, z, i, k);
      w.at[0]->values(t + w.c[i] * h, w.stage(w.position, i), w.end, w.constraint(w.residual, i));
    }
    for (std::size_t j = 0; j + 1 < s; ++j) {
      for (std::size_t c = 0; c < count; ++c) {
        T sum(0);
        for (std::size_t i = 0; i < s; ++i)
          sum = sum + w.to_multipliers[j * s + i] * w.residual[i * count + c];
        w.correction[c] = sum / h;
      }
      w.at[0]->solve(w.correction, w.correction);
      const Out<T> multiplier = w.constraint(w.multiplier, j), force = w.stage(w.force, j);
      for (std::size_t c = 0; c < count; ++c) multiplier[c] = multiplier[c] + w.correction[c];
      w.at[j]->apply_transpose(w.correction, w.impulse);
      for (std::size_t k = 0; k < n; ++k) force[k] = force[k] - w.impulse[k];
    }
  }

  // Finds, in `impulse`, the change from p0 to p1.
  template <class P>
  static Status end_momentum(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z,
                             Work<P>& w) {
    using T = Scalar<P>;
    const std::size_t n = w.n(), s = w.s();
    VelocityConstraints<T>& last = *w.at[s - 1];
    if (const Status status = w.push_to_end(p, last, t, h); status != Status::converged) return status;
    return w.onto_velocities(last, t + h, w.stage(w.position, s - 1), In<T>(z.data() + n, n),
                             In<T>(w.carry).subspan(n), w.impulse, w.end, false);
  }
};

const Method<NonholonomicLobatto> method{
    {.name = "nonholonomic-lobatto",
     .title = "Lobatto IIIA-IIIB pair for velocity constraints, order 2 s - 2",
     .family = "nonholonomic",
     .reference = "jay1998; hairer-lubich-wanner2006 II.1.4, IV.2.2",
     .description =
         "The Lobatto IIIA-IIIB pair for velocity constraints, symmetric and of order 2 s - 2 with s stages; "
         "`lobatto-spark` is its counterpart for holonomic ones. Take it for long runs of reversible systems "
         "at high accuracy, with any energy H(q, p, t). Steps are implicit in all stages, and holonomic "
         "constraints that stand beside those of velocities are kept at the level of velocities only.",
     .preserves = {Claim::symmetric, Claim::reversible, Claim::velocity_constraints,
                   Claim::nonholonomic_momentum}}};
// The former name, which was too like that of `lobatto-spark`.
const MethodAlias spark_lobatto{method, "spark-lobatto", {}};
}  // namespace
