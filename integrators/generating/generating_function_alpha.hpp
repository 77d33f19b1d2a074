// K(z,t)-symplectic schemes of any order from truncated generating functions of any alpha, in the system's
// own coordinates (su-qin (87)-(88)).
//
// The step solves
//
//   alpha_1(z', z, t + h, t) = psi(alpha_2(z', z, t + h, t))
//
// for z', psi the gradient of alpha's generating function truncated at h^m (alpha_gradient.hpp). psi is a
// gradient and alpha satisfies (34), so that z -> z' is exactly K-symplectic, M^T K(z', t + h) M = K(z, t),
// for every m and every step for which the equation can be solved; the order is m. Where alpha is symmetric,
//
//   alpha_1(z, z', t, t') = -alpha_1(z', z, t', t),   alpha_2(z, z', t, t') = alpha_2(z', z, t', t),
//
// and nothing depends on time, phi is odd in tau: the method is symmetric and of order m + 1 for odd m.
//
// The correction uses A - N C with N = (A M + B)(C M + D)^-1 (42) for the Jacobian M of the implicit midpoint
// rule instead of the step's own. The two differ by O(h^3), so that each iteration reduces the error by a
// factor of that order. The structure holds to the accuracy of this solve, which therefore ends at round-off.
// Limits: z' is found whole, not as an increment, so that there is nothing to sum with compensation; a chart,
// where there is one, is faster (generating_function.hpp).
#pragma once

#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/integrators/generating/alpha_gradient.hpp>
#include <pfaff/integrators/generating/generating_map_check.hpp>
#include <pfaff/integrators/support/beside_rounding.hpp>
#include <pfaff/integrators/support/difference_predictor.hpp>

namespace pfaff {

/// The scheme of order `truncation`. Call validate() once the parameters are set.
struct GeneratingFunctionAlpha {
  static constexpr std::size_t history_length = 8;
  static constexpr bool fixed_sizes = false;  // the work is in the series, which take no fixed size
  int truncation = 4;
  GaussCoefficients gauss;

  static std::vector<Parameter> parameters() {
    return {parameter(&GeneratingFunctionAlpha::truncation, "order", "", 1, 40,
                      "degree m at which the generating function is truncated")};
  }
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list;
    for (int m = 1; m <= (full ? 10 : 6); ++m) list.push_back({{"order", std::to_string(m)}});
    return list;
  }
  void validate() { gauss = gauss_coefficients((truncation + 1) / 2); }
  [[nodiscard]] std::string refuses(const Model& model) const {
    const GeneratingMapCheck check = check_generating_map(model);
    return check.holds ? std::string() : model.name() + ": " + check.message;
  }
  [[nodiscard]] int order(const Model& model) const {
    return truncation + (truncation % 2 == 1 && odd_in_time(model) ? 1 : 0);
  }
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const {
    std::vector<Claim> claims{Claim::symplectic, Claim::k_symplectic};
    if (odd_in_time(model)) claims.push_back(Claim::symmetric);
    return claims;
  }
  /// The weights b of the collocation: changing one breaks consistency.
  std::span<Quad> coefficients() { return gauss.weights; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    using Number = Value<T>;
    std::size_t n;
    AlphaGradient<T> gradient;
    Replay<T> alpha;
    Replay<Number> alpha_jacobian;
    std::vector<T> pair, values, psi, residual, correction, rounding, rate, middle, jacobian, last_z;
    std::vector<Number> numbers, blocks, flow, right, solved, newton_row;
    RoundedRates<T> rounded;
    LU<Number> half_step, denominator, newton;
    DifferencePredictor<T, dynamic, dynamic> past;  // of z' - z
    T last_t{0}, last_h{0};
    bool continues = false;

    Work(const GeneratingFunctionAlpha& m, const P& p)
        : n(p.size()),
          gradient(p.field_tape(), p.alpha_tape(), m.truncation, m.gauss),
          alpha(p.alpha_tape()),
          alpha_jacobian(std::make_shared<const Tape>(jacobian_tape(*p.alpha_tape()))),
          pair(2 * n + 1),
          values(2 * n),
          psi(n),
          residual(n),
          correction(n),
          rounding(n),
          rate(n),
          middle(n),
          jacobian(n * n),
          last_z(n),
          numbers(2 * n + 1),
          blocks(2 * n * (2 * n + 1)),
          flow(n * n),
          right(n),
          solved(n),
          newton_row(n),
          half_step(n),
          denominator(n),
          newton(n),
          past(n, history_length) {
      p.prepare(Formula::field);
      p.prepare(Formula::field_jacobian);
    }

    // True when this step goes on where the last one ended.
    [[nodiscard]] bool continued(const T& t, const T& h, const State<P>& z) const {
      if constexpr (!std::is_same_v<T, Number>) return false;
      if (!continues || value_of(h) != value_of(last_h)) return false;
      if (abs(value_of(t - last_t)) > abs(value_of(h)) * Number(1e-6)) return false;
      for (std::size_t k = 0; k < n; ++k)
        if (value_of(z[k]) != value_of(last_z[k])) return false;
      return true;
    }
    // Entry (i, j) of A, B, C, D: block_row 0 is w^, 1 is w; block_column 0 is z', 1 is z.
    [[nodiscard]] const Number& block(std::size_t block_row, std::size_t i, std::size_t block_column,
                                      std::size_t j) const {
      return blocks[(block_row * n + i) * (2 * n + 1) + block_column * n + j];
    }
    // Row i of [A, B] M or [C, D] M: the block of z' times M plus the block of z.
    [[nodiscard]] Number along_flow(std::size_t block_row, std::size_t i, std::size_t j) const {
      Number sum = block(block_row, i, 1, j);
      for (std::size_t k = 0; k < n; ++k) sum = sum + block(block_row, i, 0, k) * flow[k * n + j];
      return sum;
    }
  };

  template <HasGeneratingMap P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    using Number = Value<T>;
    const bool continued = w.continued(t, h, z);
    w.continues = false;
    predict(p, t, h, z, continued, w);
    if (const Status status = factor(p, t, h, w); status != Status::converged) return status;
    w.gradient.set_step(t, h);
    w.gradient.search_from(w.middle, z);
    const auto correct = [&] {
      w.alpha(t + h, w.pair.data(), w.values.data());
      if (const Status status = w.gradient(w.values.data() + w.n, w.psi.data()); status != Status::converged)
        return status;
      ++p.counters().iterations;
      p.counters().fields += static_cast<std::int64_t>(w.gradient.evaluations());
      for (std::size_t k = 0; k < w.n; ++k) w.residual[k] = w.psi[k] - w.values[k];
      w.newton.solve(w.residual.data(), w.correction.data());
      for (std::size_t k = 0; k < w.n; ++k) w.pair[k] = w.pair[k] + w.correction[k];
      return Status::converged;
    };
    Convergence<T> convergence;
    do {
      if (const Status status = correct(); status != Status::converged) return status;
      convergence.begin_iteration();
      for (std::size_t k = 0; k < w.n; ++k) convergence.add(w.correction[k], z[k], w.pair[k]);
    } while (!convergence.finished(50));
    Status status = convergence.status();
    if (status == Status::not_converged) {
      w.rounded.find(p.field_tape(), t + h / T(2), z);
      std::vector<Number> sizes(w.n);
      for (std::size_t k = 0; k < w.n; ++k) sizes[k] = w.rounded.over(h, k);
      std::copy(z.begin(), z.end(), w.rounding.begin());
      add_rounding(w.rounding, sizes, w.residual, w.correction,
                   [&w] { w.newton.solve(w.residual.data(), w.correction.data()); });
      status = end_by_rounding(50, correct, w.correction, w.rounding, w.pair);
    }
    if (status != Status::converged) return status;

    w.past.remember([&](std::size_t k) { return w.pair[k] - z[k]; });
    for (std::size_t k = 0; k < w.n; ++k) z[k] = w.last_z[k] = w.pair[k];
    w.last_t = t + h;
    w.last_h = h;
    w.continues = true;
    return Status::converged;
  }

 private:
  /// phi(w, t, t0) = -phi(w, t0, t) and nothing depends on time but through t - t0.
  [[nodiscard]] static bool odd_in_time(const Model& model) {
    return model.autonomous() && model.tape(Formula::alpha)->autonomous() &&
           check_generating_map(model).symmetric;
  }

  // The first z', and with it the pair (z', z, t) and the state halfway: from past steps, or by the explicit
  // midpoint rule.
  template <class P>
  static void predict(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, bool continued,
                      Work<P>& w) {
    using T = Scalar<P>;
    const T half = h / T(2);
    if (continued) {
      for (std::size_t k = 0; k < w.n; ++k) w.pair[k] = z[k] + w.past.expected(k);
    } else {
      w.past.forget();
      p.field(t, z, w.rate);
      for (std::size_t k = 0; k < w.n; ++k) w.middle[k] = z[k] + half * w.rate[k];
      p.field(t + half, w.middle, w.rate);
      for (std::size_t k = 0; k < w.n; ++k) w.pair[k] = z[k] + h * w.rate[k];
    }
    for (std::size_t k = 0; k < w.n; ++k) {
      w.pair[w.n + k] = z[k];
      w.middle[k] = (w.pair[k] + z[k]) / T(2);
    }
    w.pair[2 * w.n] = t;
  }

  // A - N C at the predicted pair.
  template <class P>
  static Status factor(const P& p, const Scalar<P>& t, const Scalar<P>& h, Work<P>& w) {
    using T = Scalar<P>;
    using Number = Value<T>;
    const std::size_t n = w.n;
    p.field_jacobian(t + h / T(2), w.middle, w.jacobian);
    for (const T& x : w.jacobian)
      if (!isfinite(value_of(x))) return Status::non_finite;
    // M = (I - h/2 X_z)^-1 (I + h/2 X_z), column by column.
    const Number half = value_of(h) / Number(2);
    const auto identity = [](std::size_t i, std::size_t j) { return Number(i == j ? 1 : 0); };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        w.half_step(i, j) = identity(i, j) - half * value_of(w.jacobian[i * n + j]);
    if (!w.half_step.factor()) return Status::singular;
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i)
        w.right[i] = identity(i, j) + half * value_of(w.jacobian[i * n + j]);
      w.half_step.solve(w.right.data(), w.solved.data());
      for (std::size_t i = 0; i < n; ++i) w.flow[i * n + j] = w.solved[i];
    }
    for (std::size_t k = 0; k < 2 * n + 1; ++k) w.numbers[k] = value_of(w.pair[k]);
    w.alpha_jacobian(value_of(t + h), w.numbers.data(), w.blocks.data());
    for (const Number& x : w.blocks)
      if (!isfinite(x)) return Status::non_finite;
    // Rows of N from N (C M + D) = A M + B, transposed.
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) w.denominator(i, j) = w.along_flow(1, j, i);
    if (!w.denominator.factor()) return Status::singular;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) w.right[j] = w.along_flow(0, i, j);
      w.denominator.solve(w.right.data(), w.newton_row.data());
      for (std::size_t j = 0; j < n; ++j) {
        Number sum = w.block(0, i, 0, j);
        for (std::size_t k = 0; k < n; ++k) sum = sum - w.newton_row[k] * w.block(1, k, 0, j);
        w.newton(i, j) = sum;
      }
    }
    ++p.counters().factorisations;
    return w.newton.factor() ? Status::converged : Status::singular;
  }
};

}  // namespace pfaff
