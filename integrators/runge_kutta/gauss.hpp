// Gauss collocation methods of any number of stages, and the implicit midpoint rule (one stage).
//
//   Z_i = h sum_j a_ij X(z + Z_j, t + c_j h),   z' = z + h sum_i b_i X(z + Z_i, t + c_i h)
//
// Order 2 s, symmetric, symplectic for constant K, keeps quadratic invariants (hairer-lubich-wanner2006
// II.1.3, IV.2.1, VI.4.2). Not K-symplectic for z- or t-dependent K in the variables z. The implicit midpoint
// rule is the "Euler centre" scheme of su-qin (107).
//
// Where the energy is T(p) + V(q, t) with T quadratic, the same steps are made in Nystroem's form, with half
// the unknowns and half the iterations (nystrom_form.hpp). Otherwise the rates h b_j X are iterated as they
// are. Either way they are known to round-off and belong to the stages that they make
// (stage_iteration.hpp), coefficients keep symplecticity to the last bit (collocation_coefficients.hpp), and
// updates are compensated, sums over the stages included: what rounding does to conserved quantities then has
// no trend.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/integrators/runge_kutta/nystrom_form.hpp>

namespace pfaff {

/// Gauss collocation. Where the number of stages and the size of the problem are known to the compiler, the
/// size of the workspace is, too.
template <int Stages = dynamic>
struct Collocation {
  GaussCoefficients tableau;
  bool compensated = true;

  Collocation() {
    if constexpr (Stages != dynamic) tableau = gauss_coefficients(Stages);
  }

  /// The weights b: changing one breaks consistency, and b_i a_ij + b_j a_ji = b_i b_j with it.
  std::span<Quad> coefficients() { return tableau.weights; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    using Number = Value<T>;
    using Iteration = StageIteration<T, P::extent, Stages>;

    // The form of second order, where it can be used. With one stage it would gain nothing.
    struct None {
      void restart() {}
    };
    template <class Q, bool Separable>
    struct SecondOrder {
      using type = None;
    };
    template <class Q>
    struct SecondOrder<Q, true> {
      using type = NystromForm<Q, Stages>;
    };
    static constexpr bool separable = HasSeparable<P> && Stages != 1;

    State<P> point, rate, carry;
    std::vector<T> jacobian;
    Vector<T, Stages> node, weight, scale;
    bool of_second_order = false;
    Iteration iteration;
    typename Iteration::Row counted;
    std::optional<typename SecondOrder<P, separable>::type> second_order;
    T last_h{0};

    Work(const Collocation& method, const P& problem)
        : Work(CollocationCoefficients<Number>(method.tableau), problem, velocity_of(problem)) {}

    /// Forgets the past, round-off included: the next step depends on its state alone.
    void restart() {
      iteration.forget();
      for (T& x : carry) x = T(0);
      if (second_order) second_order->restart();
    }

   private:
    // The tape of a linear velocity; null where there is none.
    static std::shared_ptr<const Tape> velocity_of(const P& problem) {
      if constexpr (separable)
        if (auto tape = separable_velocity(problem); tape != nullptr && linear(*tape)) return tape;
      return nullptr;
    }
    Work(const CollocationCoefficients<Number>& c, const P& problem, std::shared_ptr<const Tape> velocity)
        : point(problem.make_state()),
          rate(problem.make_state()),
          carry(problem.make_state()),
          node(c.stages),
          weight(c.stages),
          scale(c.stages),
          of_second_order(velocity != nullptr),
          iteration(of_second_order ? 0 : problem.size(), c.stages, c.mu, c.extrapolation, true,
                    HasFieldJacobian<P> && !of_second_order),
          counted(iteration.row_of(c.counted)) {
      for (std::size_t i = 0; i < c.stages; ++i) {
        node[i] = T(c.nodes[i]);
        weight[i] = T(c.scale[i]);
      }
      if (of_second_order) {
        if constexpr (separable) second_order.emplace(c, problem, *velocity);
      } else if constexpr (HasFieldJacobian<P>) {
        problem.prepare(Formula::field_jacobian);
        jacobian.resize(point.size() * point.size());
      }
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if constexpr (Work<P>::separable)
      if (w.of_second_order) return w.second_order->step(p, t, h, z, compensated);
    begin(p, t, h, z, w);
    const auto evaluate = [&](const auto& stages) {
      for (std::size_t i = 0; i < w.iteration.stages(); ++i) {
        for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + w.iteration.stage(stages, i, k);
        p.field(t + w.node[i] * h, w.point, w.rate);
        for (std::size_t k = 0; k < z.size(); ++k) w.iteration.set_rate(i, k, w.scale[i] * w.rate[k]);
      }
    };
    Status status = w.iteration.solve(evaluate, on_constraints(p), p.counters().iterations);
    if constexpr (HasFieldJacobian<P>)
      if (status == Status::not_converged) {
        p.field_jacobian(t + h / T(2), z, w.jacobian);
        ++p.counters().factorisations;
        status = w.iteration.solve_by_newton(
            evaluate, w.jacobian, w.scale.data(), [&z](std::size_t k) { return z[k]; },
            p.counters().iterations);
      }
    if (status != Status::converged) {
      w.iteration.forget();
      return status;
    }
    for (std::size_t k = 0; k < z.size(); ++k) {
      T change, lost;
      w.iteration.total(w.counted, k, change, lost);
      add_sum(z[k], w.carry[k], change, lost, compensated);
    }
    return Status::converged;
  }

 private:
  // On a constraint surface some components may not change but for round-off, nor their derivatives. Judged
  // by themselves such components would never converge, so that all are judged together.
  template <class P>
  static bool on_constraints(const P& p) {
    if constexpr (HasHolonomic<P> || HasVelocityConstraints<P>) return p.model()->restricted();
    return false;
  }

  // What the stages of a step start from. Where nothing is remembered, and after a change of step, the first
  // rates are all the present one.
  template <class P>
  static void begin(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    using Lane = typename Work<P>::Iteration::Lane;
    for (std::size_t i = 0; i < w.iteration.stages(); ++i) w.scale[i] = h * w.weight[i];
    if (value_of(h) != value_of(w.last_h)) w.iteration.forget();
    w.last_h = h;
    if (!w.iteration.known()) {
      p.field(t, z, w.rate);
      for (std::size_t k = 0; k < z.size(); ++k) w.iteration.begin_with(k, w.scale.data(), w.rate[k]);
    }
    for (std::size_t k = 0; k < z.size(); ++k) {
      for (std::size_t b = 0; b < w.iteration.blocks(); ++b) w.iteration.line(k, b) = Lane(w.carry[k]);
      // Rates far smaller than what they are added to need not be known to their own last digit.
      w.iteration.small(k) = {};
      w.iteration.small(k).add(z[k] / T(4096));
    }
  }
};

/// Gauss collocation of a number of stages known at run time.
struct Gauss : Collocation<> {
  int stages = 2;
  static std::vector<Parameter> parameters() {
    return {parameter(&Gauss::stages, "stages", "", 1, 32, "number of stages s; the order is 2 s"),
            parameter<Gauss>(static_cast<bool Gauss::*>(&Gauss::compensated), "compensated",
                             "compensated summation")};
  }
  /// Up to six stages: beyond, quad has too few digits between the first error and round-off to see a slope.
  static std::vector<Assignments> instances(bool /*full*/) {
    std::vector<Assignments> list;
    for (int s = 1; s <= 6; ++s) list.push_back({{"stages", std::to_string(s)}});
    return list;
  }
  void validate() { tableau = gauss_coefficients(stages); }
  [[nodiscard]] int order(const Model& /*model*/) const { return 2 * stages; }
};

/// Gauss collocation with one stage.
struct ImplicitMidpoint : Collocation<1> {
  static std::vector<Parameter> parameters() {
    return {parameter<ImplicitMidpoint>(static_cast<bool ImplicitMidpoint::*>(&ImplicitMidpoint::compensated),
                                        "compensated", "compensated summation")};
  }
};

}  // namespace pfaff
