// Gauss collocation methods of any number of stages, and the implicit midpoint rule (one stage).
//
//   Z_i = h sum_j a_ij X(z + Z_j, t + c_j h),   z' = z + h sum_i b_i X(z + Z_i, t + c_i h)
//
// Order 2 s, symmetric, symplectic for constant K, keeps quadratic invariants (hairer-lubich-wanner2006
// II.1.3, IV.2.1, VI.4.2). Not K-symplectic for z- or t-dependent K in the variables z. The implicit midpoint
// rule is the "Euler centre" scheme of su-qin (107).
//
// Stages are iterated to round-off. A fixed-point iteration starts from the collocation polynomial of the
// step before, extrapolated into this step. Where it contracts slowly, simplified Newton iteration takes
// over. The update is compensated.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/registry/parameter.hpp>
#include <pfaff/core/solve/newton.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/runge_kutta/gauss_coefficients.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>
#include <pfaff/integrators/support/largest.hpp>

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
    static constexpr int product(int a, int b) { return a == dynamic || b == dynamic ? dynamic : a * b; }
    using AllStages = Vector<T, product(Stages, P::extent)>;  // [stage][component]
    // The polynomial through s stages predicts as much as s - 1 differences, so that fewer are needed to
    // reach round-off.
    static constexpr int levels(int stages) { return std::max(difference_levels<T> + 1 - stages, 1); }

    Vector<T, Stages> b, c;
    State<P> point, carry;
    Vector<T, product(Stages, Stages)> a, extrapolation;
    AllStages stage, rate, extrapolated;
    // What extrapolation of the collocation polynomial missed in past steps of size last_h.
    DifferencePredictor<T, product(Stages, P::extent), Stages == dynamic ? dynamic : levels(Stages)> missed;
    bool history = false;
    T last_h{0};
    // For Newton's iteration.
    std::vector<T> reference, residual, correction, jacobian;
    LU<Value<T>> matrix;

    Work(const Collocation& method, const P& problem)
        : b(static_cast<std::size_t>(method.tableau.stages)),
          c(b.size()),
          point(problem.make_state()),
          carry(problem.make_state()),
          a(s() * s()),
          extrapolation(s() * s()),
          stage(s() * n()),
          rate(s() * n()),
          extrapolated(s() * n()),
          missed(s() * n(), static_cast<std::size_t>(levels(method.tableau.stages))),
          reference(s() * n()),
          residual(s() * n()),
          correction(s() * n()),
          jacobian(n() * n()),
          matrix(s() * n()) {
      const GaussCoefficients& g = method.tableau;
      for (std::size_t i = 0; i < s(); ++i) {
        b[i] = T(Real(g.weights[i]));
        c[i] = T(Real(g.nodes[i]));
        for (std::size_t j = 0; j < s(); ++j) {
          a[i * s() + j] = T(Real(g.matrix[i * s() + j]));
          extrapolation[i * s() + j] = T(Real(lagrange(g.nodes, j, Quad(1) + g.nodes[i])));
        }
      }
      if constexpr (HasFieldJacobian<P>) problem.prepare(Formula::field_jacobian);
    }

    [[nodiscard]] std::size_t s() const { return b.size(); }
    [[nodiscard]] std::size_t n() const { return point.size(); }

    // rate_i = X(z + stage_i)
    void evaluate(const P& p, const T& t, const T& h, const State<P>& z) {
      for (std::size_t i = 0; i < s(); ++i) {
        for (std::size_t k = 0; k < n(); ++k) point[k] = z[k] + (stage[i * n() + k] + carry[k]);
        p.field(t + c[i] * h, point, Out<T>(rate.data() + i * n(), n()));
      }
    }
    // The rates to begin with: the collocation polynomial of the step before, extrapolated into this step,
    // and what this extrapolation is expected to miss.
    void predict() {
      for (std::size_t i = 0; i < s(); ++i)
        for (std::size_t k = 0; k < n(); ++k)
          extrapolated[i * n() + k] = sum(extrapolation.data() + i * s(), k);
      for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = extrapolated[k] + missed.expected(k);
    }
    void forget() {
      missed.forget();
      history = false;
    }
    /// Forgets the past, round-off included: the next step depends on its state alone.
    void restart() {
      forget();
      for (T& x : carry) x = T(0);
    }
    void remember(const T& h) {
      if (history) missed.remember([this](std::size_t k) { return rate[k] - extrapolated[k]; });
      history = true;
      last_h = h;
    }
    // sum_j weights_j rate_j, component k
    [[nodiscard]] T sum(const T* weights, std::size_t k) const {
      T total = weights[0] * rate[k];
      for (std::size_t j = 1; j < s(); ++j) total = total + weights[j] * rate[j * n() + k];
      return total;
    }
    // h sum_j a_ij rate_j, component k
    [[nodiscard]] T combined(std::size_t i, std::size_t k, const T& h) const {
      return h * sum(a.data() + i * s(), k);
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    predict(p, t, h, z, w);
    Convergence<T> convergence;
    bool slow = false, stagnant = false;
    do {
      w.evaluate(p, t, h, z);
      convergence.begin_iteration();
      if (on_constraints(p)) {
        stagnant = advance_together<P>(z, h, w, convergence);
      } else {
        for (std::size_t i = 0; i < w.s(); ++i)
          for (std::size_t k = 0; k < w.n(); ++k) {
            T& stage = w.stage[i * w.n() + k];
            const T next = w.combined(i, k, h);
            convergence.add(next - stage, z[k], next);
            stage = next;
          }
      }
      ++p.counters().iterations;
      slow = HasFieldJacobian<P> && convergence.iterations() >= 10 && !stagnant &&
             convergence.ratio() > Value<T>(0.6);
    } while (!slow && !convergence.finished(60));
    Status status = convergence.status();
    if constexpr (HasFieldJacobian<P>)
      if (slow || status == Status::not_converged) status = solve_by_newton(p, t, h, z, w);
    if (status != Status::converged) {
      w.forget();
      return status;
    }
    w.remember(h);
    for (std::size_t k = 0; k < w.n(); ++k) add_to(z[k], w.carry[k], h * w.sum(w.b.data(), k), compensated);
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
  // True where the corrections are only round-off. They contract no further, which is no reason for Newton's
  // iteration.
  template <class P>
  [[gnu::noinline]] static bool advance_together(const State<P>& z, const Scalar<P>& h, Work<P>& w,
                                                 Convergence<Scalar<P>>& convergence) {
    using T = Scalar<P>;
    Largest<T> correction, reference;
    for (std::size_t i = 0; i < w.s(); ++i)
      for (std::size_t k = 0; k < w.n(); ++k) {
        T& stage = w.stage[i * w.n() + k];
        const T next = w.combined(i, k, h);
        correction.add(next - stage);
        reference.add(z[k] + next);
        stage = next;
      }
    const T moved = correction.get(), size = reference.get();
    convergence.add(moved, size, size);
    return relative_size(moved, size, size) <= Value<T>(65536) * unit_roundoff<T>();
  }

  // First stages, from what is remembered; at the start, and after a change of step, from the present slope.
  template <class P>
  void predict(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) const {
    const std::size_t n = w.n();
    if (w.history && value_of(h) == value_of(w.last_h)) {
      w.predict();
    } else {
      w.forget();
      p.field(t, z, Out<Scalar<P>>(w.rate.data(), n));
      for (std::size_t k = n; k < w.rate.size(); ++k) w.rate[k] = w.rate[k - n];
    }
    for (std::size_t i = 0; i < w.s(); ++i)
      for (std::size_t k = 0; k < n; ++k) w.stage[i * n + k] = w.combined(i, k, h);
  }

  template <HasFieldJacobian P>
  [[gnu::noinline]] Status solve_by_newton(const P& p, const Scalar<P>& t, const Scalar<P>& h,
                                           const State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = w.n(), s = w.s();
    p.field_jacobian(t + h / T(2), z, w.jacobian);
    for (std::size_t row = 0; row < n * s; ++row)
      for (std::size_t column = 0; column < n * s; ++column) {
        const T coupling = h * w.a[row / n * s + column / n] * w.jacobian[row % n * n + column % n];
        w.matrix(row, column) = (row == column ? Value<T>(1) : Value<T>(0)) - value_of(coupling);
      }
    ++p.counters().factorisations;
    if (!w.matrix.factor()) return Status::singular;
    for (std::size_t i = 0; i < s; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        w.reference[i * n + k] = z[k];
        w.stage[i * n + k] = T(0);
      }
    int iterations = 0;
    const Status status = newton<T>(
        w.matrix,
        [&](std::span<T> /*stages*/, std::span<T> residual) {
          w.evaluate(p, t, h, z);
          for (std::size_t i = 0; i < s; ++i)
            for (std::size_t k = 0; k < n; ++k)
              residual[i * n + k] = w.stage[i * n + k] - w.combined(i, k, h);
        },
        w.stage, w.reference, w.residual, w.correction, 100, iterations);
    p.counters().iterations += iterations;
    return status;
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
