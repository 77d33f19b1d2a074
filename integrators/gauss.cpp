// Gauss collocation methods of any number of stages, and the implicit midpoint rule (one stage).
//
//   Z_i = h sum_j a_ij X(z + Z_j, t + c_j h),   z' = z + h sum_i b_i X(z + Z_i, t + c_i h)
//
// Order 2 s, symmetric, symplectic for constant K, keeps quadratic invariants (hairer-lubich-wanner2006 II.1.3,
// IV.2.1, VI.4.2). Not K-symplectic for z- or t-dependent K in the variables z. The implicit midpoint rule is the
// "Euler centre" scheme of su-qin (107).
//
// Stages are iterated to round-off: fixed point from the extrapolated collocation polynomial of the step before,
// simplified Newton where the contraction is slow. The update is compensated.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/newton.hpp>
#include <pfaff/integrators/gauss_coefficients.hpp>

namespace {
using namespace pfaff;

struct Collocation {
  GaussCoefficients tableau;
  bool compensated = true;

  /// The weights b: changing one breaks consistency, and b_i a_ij + b_j a_ji = b_i b_j with it.
  std::span<Quad> coefficients() { return tableau.weights; }

  template <class P> struct Work {
    using T = Scalar<P>;
    std::size_t n, s;
    std::vector<T> a, b, c, extrapolation;
    std::vector<T> stage, rate, next, correction, reference;
    State<P> point, carry;
    std::vector<T> jacobian;
    LU<Value<T>> matrix;
    T last_h{0};
    bool history = false;

    Work(const Collocation& method, const P& problem)
        : n(problem.size()), s(static_cast<std::size_t>(method.tableau.stages)), stage(n * s), rate(n * s),
          next(n * s), correction(n * s), reference(n * s), point(n), carry(n), jacobian(n * n), matrix(n * s) {
      const GaussCoefficients& g = method.tableau;
      for (const Quad x : g.matrix) a.push_back(T(Real(x)));
      for (const Quad x : g.weights) b.push_back(T(Real(x)));
      for (const Quad x : g.nodes) c.push_back(T(Real(x)));
      for (std::size_t i = 0; i < s; ++i)
        for (std::size_t j = 0; j < s; ++j)
          extrapolation.push_back(T(Real(lagrange(g.nodes, j, Quad(1) + g.nodes[i]))));
      if constexpr (HasFieldJacobian<P>) problem.prepare(Formula::field_jacobian);
    }

    // rate_i = X(z + stage_i)
    void evaluate(const P& p, const T& t, const T& h, const State<P>& z, const T* stages) {
      for (std::size_t i = 0; i < s; ++i) {
        for (std::size_t k = 0; k < n; ++k) point[k] = z[k] + (stages[i * n + k] + carry[k]);
        p.field(t + c[i] * h, point, Out<T>(rate.data() + i * n, n));
      }
    }
    // h sum_j a_ij rate_j, component k
    [[nodiscard]] T combined(std::size_t i, std::size_t k, const T& h) const {
      T sum = a[i * s] * rate[k];
      for (std::size_t j = 1; j < s; ++j) sum = sum + a[i * s + j] * rate[j * n + k];
      return h * sum;
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    predict(p, t, h, z, w);
    Convergence<T> convergence;
    bool slow = false;
    do {
      w.evaluate(p, t, h, z, w.stage.data());
      convergence.begin_iteration();
      for (std::size_t i = 0; i < w.s; ++i)
        for (std::size_t k = 0; k < w.n; ++k) {
          T& stage = w.stage[i * w.n + k];
          const T next = w.combined(i, k, h);
          convergence.add(next - stage, z[k], next);
          stage = next;
        }
      ++p.counters().iterations;
      slow = HasFieldJacobian<P> && convergence.iterations() >= 10 && convergence.ratio() > Value<T>(0.6);
    } while (!slow && !convergence.finished(60));
    Status status = convergence.status();
    if constexpr (HasFieldJacobian<P>)
      if (slow || status == Status::not_converged) status = solve_by_newton(p, t, h, z, w);
    if (status != Status::converged) {
      w.history = false;
      return status;
    }
    for (std::size_t k = 0; k < w.n; ++k) {
      T sum = w.b[0] * w.rate[k];
      for (std::size_t j = 1; j < w.s; ++j) sum = sum + w.b[j] * w.rate[j * w.n + k];
      add_to(z[k], w.carry[k], h * sum, compensated);
    }
    w.history = true;
    w.last_h = h;
    return Status::converged;
  }

 private:
  template <class P>
  void predict(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    // The polynomial of the step before, one step on; at the start, and after a change of step, the present slope.
    const bool extrapolate = w.history && value_of(h) == value_of(w.last_h);
    if (extrapolate) {
      for (std::size_t i = 0; i < w.s; ++i)
        for (std::size_t k = 0; k < w.n; ++k) {
          T sum = w.extrapolation[i * w.s] * w.rate[k];
          for (std::size_t j = 1; j < w.s; ++j) sum = sum + w.extrapolation[i * w.s + j] * w.rate[j * w.n + k];
          w.next[i * w.n + k] = sum;
        }
      std::swap(w.rate, w.next);
    } else {
      p.field(t, z, Out<T>(w.rate.data(), w.n));
      for (std::size_t i = 1; i < w.s; ++i)
        for (std::size_t k = 0; k < w.n; ++k) w.rate[i * w.n + k] = w.rate[k];
    }
    for (std::size_t i = 0; i < w.s; ++i)
      for (std::size_t k = 0; k < w.n; ++k) w.stage[i * w.n + k] = w.combined(i, k, h);
  }

  template <HasFieldJacobian P>
  Status solve_by_newton(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = w.n;
    p.field_jacobian(t + h / T(2), z, w.jacobian);
    for (std::size_t row = 0; row < n * w.s; ++row)
      for (std::size_t column = 0; column < n * w.s; ++column) {
        const T coupling = h * w.a[row / n * w.s + column / n] * w.jacobian[row % n * n + column % n];
        w.matrix(row, column) = (row == column ? Value<T>(1) : Value<T>(0)) - value_of(coupling);
      }
    ++p.counters().factorisations;
    if (!w.matrix.factor()) return Status::singular;
    for (std::size_t i = 0; i < w.s; ++i)
      for (std::size_t k = 0; k < n; ++k) {
        w.reference[i * n + k] = z[k];
        w.stage[i * n + k] = T(0);
      }
    int iterations = 0;
    const Status status = newton<T>(
        w.matrix,
        [&](std::span<T> x, std::span<T> r) {
          w.evaluate(p, t, h, z, x.data());
          for (std::size_t i = 0; i < w.s; ++i)
            for (std::size_t k = 0; k < n; ++k) r[i * n + k] = x[i * n + k] - w.combined(i, k, h);
        },
        w.stage, w.reference, w.next, w.correction, 100, iterations);
    p.counters().iterations += iterations;
    return status;
  }
};

struct Gauss : Collocation {
  int stages = 2;
  static std::vector<Parameter> parameters() {
    return {parameter(&Gauss::stages, "stages", "", 1, 32, "number of stages s; the order is 2 s"),
            parameter<Gauss>(static_cast<bool Gauss::*>(&Gauss::compensated), "compensated", "compensated summation")};
  }
  void validate() { tableau = gauss_coefficients(stages); }
  [[nodiscard]] int order(const Model& /*model*/) const { return 2 * stages; }
};

struct ImplicitMidpoint : Collocation {
  static std::vector<Parameter> parameters() {
    return {parameter<ImplicitMidpoint>(static_cast<bool ImplicitMidpoint::*>(&ImplicitMidpoint::compensated),
                                        "compensated", "compensated summation")};
  }
  void validate() { tableau = gauss_coefficients(1); }
};

const Method<Gauss> gauss{{.name = "gauss",
                           .title = "Gauss collocation, order 2 s",
                           .reference = "hairer-lubich-wanner2006 (II.1.3)",
                           .preserves = {Claim::symmetric, Claim::symplectic, Claim::quadratic_invariants}}};
const Method<ImplicitMidpoint> midpoint{
    {.name = "implicit-midpoint",
     .title = "implicit midpoint rule (Euler centre scheme)",
     .reference = "su-qin (107); hairer-lubich-wanner2006 (II.1.4)",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::symplectic, Claim::quadratic_invariants}}};
}  // namespace
