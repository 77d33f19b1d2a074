// K(z,t)-symplectic schemes of any order from truncated generating functions (su-qin (87)-(88)).
//
// In Darboux coordinates y = chart(z, t), with w = P y' + (I - P) y:   y' = y + psi(w),
// psi the gradient of the generating function truncated at tau^m (generating_gradient.hpp). Exactly
// K-symplectic for every m and every step for which it can be solved; order m, and m + 1 for odd m in the
// midpoint form where the field in the chart does not depend on time. With m = 1 and the midpoint form this
// is su-qin (102), with m = 2 variant P the corrected (105). Variant S, even m, expands at the mid-time:
// symmetric as well.
//
// The structure holds to the accuracy of the implicit solve, which therefore ends at round-off in every
// component: a chart such as (r, e^{nu t} p) mixes numbers forty decades apart.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>
#include <pfaff/integrators/generating_gradient.hpp>

namespace pfaff {

/// The scheme of order `truncation`. Call validate() once the parameters are set.
struct GeneratingFunction {
  static constexpr std::size_t history_length = 8;
  static constexpr bool fixed_sizes = false;  // the work is in the series, whose size is its own
  int truncation = 4;
  std::string variant = "auto", form = "midpoint";
  bool compensated = true;
  GaussCoefficients gauss;

  static std::vector<Parameter> parameters() {
    using G = GeneratingFunction;
    return {parameter(&G::truncation, "order", "", 1, 40,
                      "degree m at which the generating function is truncated"),
            parameter(
                &G::variant, "variant", {"auto", "P", "S"},
                "P expands at the start of the step, S at its middle (even orders); auto: S where it can be"),
            parameter(&G::form, "form", {"midpoint", "qhat-p", "q-phat"},
                      "which old and new coordinates w mixes"),
            parameter(&G::compensated, "compensated", "compensated summation")};
  }
  /// Every order to 12 in the variant it takes by default; variant P of even orders, and the mixed forms.
  static std::vector<Assignments> instances(bool full) {
    std::vector<Assignments> list;
    const int highest = full ? 16 : 12;  // beyond 16 quad has too few digits to see a slope
    for (int m = 1; m <= highest; ++m) list.push_back({{"order", std::to_string(m)}});
    for (int m = 2; m <= highest; m += 2) list.push_back({{"order", std::to_string(m)}, {"variant", "P"}});
    for (int m = 1; m <= (full ? 12 : 6); ++m)
      for (const char* mixed : {"qhat-p", "q-phat"})
        list.push_back({{"order", std::to_string(m)}, {"form", mixed}});
    return list;
  }
  void validate() {
    const bool even = truncation % 2 == 0;
    if (variant == "S" && !even)
      throw InputError("integrator generating-function: variant S needs an even order, got order " +
                       std::to_string(truncation) + "; expected variant P or an even order");
    if (variant == "S" && form != "midpoint")
      throw InputError("integrator generating-function: variant S needs form midpoint, got '" + form + "'");
    gauss = gauss_coefficients((truncation + 1) / 2);
  }
  [[nodiscard]] bool symmetric_variant() const {
    return variant == "S" || (variant == "auto" && truncation % 2 == 0 && form == "midpoint");
  }
  [[nodiscard]] GeneratingForm generating_form() const {
    if (form == "midpoint") return GeneratingForm::midpoint;
    return form == "qhat-p" ? GeneratingForm::new_q_old_p : GeneratingForm::old_q_new_p;
  }
  [[nodiscard]] int order(const Model& model) const {
    const bool gains = truncation % 2 == 1 && form == "midpoint" && model.chart_autonomous();
    return truncation + (gains ? 1 : 0);
  }
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const {
    std::vector<Claim> claims{Claim::symplectic, Claim::k_symplectic};
    if (symmetric_variant() || (form == "midpoint" && model.chart_autonomous()))
      claims.push_back(Claim::symmetric);
    return claims;
  }
  /// The weights b of the collocation: changing one breaks consistency.
  std::span<Quad> coefficients() { return gauss.weights; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::size_t n;
    GeneratingGradient<T> gradient;
    std::vector<T> y, carry, d, w, psi, residual, correction, jacobian, last_z;
    std::vector<T> differences;  // backward differences of d over past steps, [k][component]
    std::size_t depth = 0;       // how many of them are known
    LU<Value<T>> matrix;
    T last_t{0}, last_h{0};
    bool continues = false;

    Work(const GeneratingFunction& m, const P& p)
        : n(p.size()),
          gradient(p.chart_field_tape(), m.truncation, m.symmetric_variant(), m.generating_form(), m.gauss),
          y(n),
          carry(n),
          d(n),
          w(n),
          psi(n),
          residual(n),
          correction(n),
          jacobian(n * n),
          last_z(n),
          differences((history_length + 1) * n),
          matrix(n) {
      p.prepare(Formula::chart_field);
      p.prepare(Formula::chart_field_jacobian);
      p.prepare(Formula::chart);
      p.prepare(Formula::chart_inverse);
    }

    // True when this step goes on where the last one ended: its chart coordinates and history are still good.
    [[nodiscard]] bool continued(const T& t, const T& h, const State<P>& z) const {
      if constexpr (!std::is_same_v<T, Value<T>>) return false;
      if (!continues || value_of(h) != value_of(last_h)) return false;
      if (abs(value_of(t - last_t)) > abs(value_of(h)) * Value<T>(1e-6)) return false;
      for (std::size_t k = 0; k < n; ++k)
        if (value_of(z[k]) != value_of(last_z[k])) return false;
      return true;
    }

    // d = P psi of the past steps extrapolated by backward differences, as many as help.
    void predict() {
      std::size_t terms = 1;
      const auto size = [&](std::size_t k) {
        Value<T> sum(0);
        for (std::size_t i = 0; i < n; ++i) {
          const Value<T> scale = abs(value_of(differences[i]));
          if (scale > Value<T>(0)) sum = sum + abs(value_of(differences[k * n + i])) / scale;
        }
        return sum;
      };
      for (Value<T> last = size(0); terms < depth; ++terms) {
        const Value<T> next = size(terms);
        if (!(next < last)) break;
        last = next;
      }
      for (std::size_t i = 0; i < n; ++i) {
        d[i] = T(0);
        for (std::size_t k = 0; k < terms; ++k) d[i] = d[i] + differences[k * n + i];
      }
    }
    void remember() {
      for (std::size_t i = 0; i < n; ++i) {
        T difference = d[i];
        for (std::size_t k = 0; k <= std::min(depth, history_length); ++k) {
          const T previous = differences[k * n + i];
          differences[k * n + i] = difference;
          difference = difference - previous;
        }
      }
      depth = std::min(depth + 1, history_length);
    }
  };

  template <HasDarbouxChart P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const T middle = t + h / T(2);
    if (!w.continued(t, h, z)) {
      p.chart(t, z, w.y);
      for (T& x : w.carry) x = T(0);
      w.depth = 0;
    }
    if (w.depth > 0) {
      w.predict();
    } else {  // half an Euler step from the middle of half an Euler step
      p.chart_field(t, w.y, w.psi);
      for (std::size_t k = 0; k < w.n; ++k) w.w[k] = w.y[k] + h / T(2) * w.psi[k];
      p.chart_field(middle, w.w, w.psi);
      for (std::size_t k = 0; k < w.n; ++k) w.d[k] = w.gradient.share(k) * h * w.psi[k];
    }
    place(w);
    p.chart_field_jacobian(middle, w.w, w.jacobian);
    for (std::size_t i = 0; i < w.n; ++i)
      for (std::size_t j = 0; j < w.n; ++j)
        w.matrix(i, j) = (i == j ? Value<T>(1) : Value<T>(0)) -
                         value_of(w.gradient.share(i)) * value_of(h) * value_of(w.jacobian[i * w.n + j]);
    ++p.counters().factorisations;
    for (const T& x : w.jacobian)
      if (!isfinite(value_of(x))) return fail(w, Status::non_finite);
    if (!w.matrix.factor()) return fail(w, Status::singular);

    w.gradient.set_step(t, h);
    Convergence<T> convergence;
    do {
      w.gradient(w.w.data(), w.psi.data());
      ++p.counters().iterations;
      p.counters().fields += static_cast<std::int64_t>(w.gradient.evaluations());
      for (std::size_t k = 0; k < w.n; ++k) w.residual[k] = w.gradient.share(k) * w.psi[k] - w.d[k];
      w.matrix.solve(w.residual.data(), w.correction.data());
      convergence.begin_iteration();
      for (std::size_t k = 0; k < w.n; ++k) {
        w.d[k] = w.d[k] + w.correction[k];
        convergence.add(w.correction[k], w.y[k], w.psi[k]);
      }
      place(w);
    } while (!convergence.finished(50));
    if (convergence.status() != Status::converged) return fail(w, convergence.status());

    const bool midpoint = generating_form() == GeneratingForm::midpoint;
    if (!midpoint) w.gradient(w.w.data(), w.psi.data());
    for (std::size_t k = 0; k < w.n; ++k)
      add_to(w.y[k], w.carry[k], midpoint ? w.d[k] + w.d[k] : w.psi[k], compensated);
    w.remember();
    w.last_t = t + h;
    w.last_h = h;
    p.chart_inverse(w.last_t, w.y, z);
    for (std::size_t k = 0; k < w.n; ++k) w.last_z[k] = z[k];
    w.continues = true;
    return Status::converged;
  }

 private:
  // w = y + d, with what the sums so far have rounded off.
  template <class W>
  static void place(W& w) {
    for (std::size_t k = 0; k < w.n; ++k) w.w[k] = w.y[k] + (w.d[k] + w.carry[k]);
  }
  template <class W>
  static Status fail(W& w, Status status) {
    w.continues = false;
    return status;
  }
};

}  // namespace pfaff
