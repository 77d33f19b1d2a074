// K(z,t)-symplectic schemes of any order from truncated generating functions (su-qin (87)-(88)).
//
// In Darboux coordinates y = chart(z, t), with w = P y' + (I - P) y:   y' = y + psi(w),
// psi the gradient of the generating function truncated at tau^m (generating_gradient.hpp), P a normal
// Darboux matrix (generating_share.hpp). Exactly K-symplectic for every m and every step for which it can be
// solved; order m, and m + 1 for odd m in the midpoint form where the field in the chart does not depend on
// time. With m = 1 and the midpoint form this is su-qin (102), with m = 2 variant P the corrected (105).
// Variant S, even m, expands at the mid-time: symmetric as well. Degrees beyond m, from the same nodes, bring
// the error constant close to that of Gauss collocation in the chart (extra_degrees.hpp); without them the
// scheme is su-qin's.
//
// The step solves w = y + P psi(w), with Y the field in the chart. A first w is predicted from past steps or
// by a Taylor series (expected_change.hpp) and corrected with one factorisation (correction_matrix.hpp) or,
// for many degrees of freedom, without derivatives.
// From the second correction on these matrices are improved by what the corrections have shown
// (secant_updates.hpp), which halves the evaluations of psi in long steps. In the midpoint form the new state
// is y + psi(w) at the last w that was evaluated, and what its correction changes of psi. This
// rounds as w - y doubled does, with a bias that docs/drift-and-cost.md measures. The structure holds only as
// accurately as this equation is solved. The iteration therefore goes on to round-off in every component by
// itself, because a chart such as (r, e^{nu t} p) mixes numbers forty decades apart. Where a motion comes to
// rest a component is smaller than what the forces that cancel there round (beside_rounding.hpp): after 25
// iterations in vain the step begins anew without secants, and is judged by that. A step so long that only
// secants solve it, and slowly, does not converge in this way either, and is tried with them once more.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/solve/summation.hpp>
#include <pfaff/integrators/generating/correction_matrix.hpp>
#include <pfaff/integrators/generating/correction_without_matrix.hpp>
#include <pfaff/integrators/generating/expected_change.hpp>
#include <pfaff/integrators/generating/extra_degrees.hpp>
#include <pfaff/integrators/generating/gradient_evaluator.hpp>
#include <pfaff/integrators/support/beside_rounding.hpp>
#include <pfaff/integrators/support/continuation.hpp>
#include <pfaff/integrators/support/remembered_contraction.hpp>
#include <pfaff/integrators/support/secant_convergence.hpp>
#include <pfaff/integrators/support/secant_updates.hpp>

namespace pfaff {

/// The scheme of order `truncation`. Call validate() once the parameters are set.
struct GeneratingFunction {
  /// The largest number of coordinates for which the correction factors a matrix.
  static constexpr std::size_t largest_matrix = 8;
  /// The most iterations of a step, and the most of one that begins anew.
  static constexpr int first_iterations = 25, most_iterations = 50;
  int truncation = 4;
  std::string variant = "auto", form = "midpoint", extra = "auto";
  std::vector<Real> normal;
  bool compensated = true;
  GaussCoefficients gauss;

  static std::vector<Parameter> parameters() {
    using G = GeneratingFunction;
    return {
        parameter(&G::truncation, "order", "", 1, 40,
                  "degree m at which the generating function is truncated"),
        parameter(
            &G::variant, "variant", {"auto", "P", "S"},
            "P expands at the start of the step, S at its middle (even orders); auto: S where it can be"),
        parameter(&G::form, "form", {"midpoint", "qhat-p", "q-phat", "normal"},
                  "which old and new coordinates w mixes"),
        parameter(&G::normal, "normal", "", -100, 100,
                  "form normal: V of P = (I + V)/2 by rows, or a,b,c,d for its blocks a I, b I, c I, d I"),
        parameter(&G::extra, "extra", {"auto", "0", "2", "4", "6", "8"},
                  "degrees kept beyond m, from the same nodes; 0: the scheme of su-qin; auto: in variant S "
                  "what costs least at equal error, 2 at orders 6 and 10, 4 at order 8, 0 at others; else 0"),
        parameter(&G::compensated, "compensated", "compensated summation")};
  }
  void validate() {
    const auto refuse = [](const std::string& text) { throw InputError(text); };
    if (variant == "S" && truncation % 2 != 0)
      refuse("variant S needs an even order, got order " + std::to_string(truncation) +
             "; expected variant P or an even order");
    if (variant == "S" && form != "midpoint") refuse("variant S needs form midpoint, got '" + form + "'");
    if ((form == "normal") != !normal.empty())
      refuse(form == "normal" ? "form normal needs its matrix, e.g. normal=0.3,0.2,-0.4,-0.3"
                              : "a matrix is given with form " + form + "; expected form normal");
    gauss = gauss_coefficients((truncation + 1) / 2);
  }
  [[nodiscard]] bool symmetric_variant() const {
    return variant == "S" || (variant == "auto" && truncation % 2 == 0 && form == "midpoint");
  }
  /// The degrees kept beyond m.
  [[nodiscard]] int extra_degrees() const {
    if (extra != "auto") return std::stoi(extra);
    return symmetric_variant() ? cheapest_extra_degrees(truncation) : 0;
  }
  [[nodiscard]] GeneratingShare share() const {
    if (form == "normal") return GeneratingShare(normal);
    return form == "midpoint" ? GeneratingForm::midpoint
           : form == "qhat-p" ? GeneratingForm::new_q_old_p
                              : GeneratingForm::old_q_new_p;
  }
  [[nodiscard]] std::string refuses(const Model& model) const {
    const auto n = static_cast<std::size_t>(model.dimension());
    if (!share().fits(n))
      return "has a matrix of " + std::to_string(normal.size()) + " entries; " + model.name() +
             " takes 4 or " + std::to_string(n * n);
    if (const Quad defect = share().defect(n); defect > Quad(1e-30))
      return "has a matrix V that is not in sp(" + std::to_string(n) + "): J V + V^T J is " +
             to_string(defect, 3) + ", expected 0";
    return {};
  }
  [[nodiscard]] int order(const Model& model) const {
    if (extra_degrees() > 0) return 2 * gauss.stages;
    const bool gains = truncation % 2 == 1 && form == "midpoint" && model.chart_autonomous();
    return truncation + (gains ? 1 : 0);
  }
  [[nodiscard]] std::vector<Claim> preserves(const Model& model) const {
    std::vector<Claim> claims{Claim::symplectic, Claim::k_symplectic};
    if (symmetric_variant() || (form == "midpoint" && model.chart_autonomous()))
      claims.push_back(Claim::symmetric);
    // The midpoint form commutes with linear maps of the chart. Canonical coordinates are their own chart, in
    // which a linear reversal of the motion is such a map.
    if (form == "midpoint" && model.canonical() && model.chart_autonomous())
      claims.push_back(Claim::reversible);
    return claims;
  }
  /// The weights b of the collocation: changing one breaks consistency.
  std::span<Quad> coefficients() { return gauss.weights; }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    ShareMatrix<T> share;
    bool midpoint;
    GradientEvaluator<T> gradient;
    State<P> y, carry, d, w, psi, residual, correction;
    State<P> change;  // of y: what is expected of it, and in the end what it is
    ExpectedChange<P> forecast;
    SecantUpdates<T, P::extent> secants;
    CorrectionMatrix<P> matrix;
    CorrectionWithoutMatrix<P> without_matrix;
    Vector<Value<T>, P::extent> predicted;  // of d
    std::array<Value<T>, 2> largest{};      // of the positions and of the momenta in the chart
    Continuation<P> continuation;
    RememberedContraction<Value<T>> contraction;  // of the corrections: the slowest since the start
    RoundedRates<T> rounded;
    std::vector<Value<T>> sizes;  // of what the rates round over a step, and
    std::vector<T> rounding;      // references with it; made by the first step that asks for them

    Work(const GeneratingFunction& m, const P& p) : Work(m, p, p.size()) {
      p.prepare(Formula::chart_field);
      if (factors()) p.prepare(Formula::chart_field_jacobian);
      p.prepare(Formula::chart);
      p.prepare(Formula::chart_inverse);
    }
    Work(const GeneratingFunction& m, const P& p, std::size_t n)
        : share(m.share(), n),
          midpoint(m.share().midpoint(n)),
          gradient(p, m.truncation, m.symmetric_variant(), m.extra_degrees(), m.share(), m.gauss),
          y(n),
          carry(n),
          d(n),
          w(n),
          psi(n),
          residual(n),
          correction(n),
          change(n),
          forecast(p, m.truncation + m.extra_degrees(), gradient.evaluations()),
          secants(n),
          matrix(factors() ? n : 0, m.truncation + m.extra_degrees() > 2),
          without_matrix(n),
          predicted(n),
          continuation(p) {}

    [[nodiscard]] bool factors() const { return y.size() <= largest_matrix; }
    // 0 for a position in the chart, 1 for a momentum.
    [[nodiscard]] std::size_t kind(std::size_t k) const { return 2 * k < y.size() ? 0 : 1; }
    // What corrections of component k are measured by: the component, or 2^-26 of the largest position or
    // momentum, so that the front of a wave that enters a chain need not be known to its own last digit.
    // Derivatives are measured by those of the component.
    [[nodiscard]] T reference(std::size_t k) const {
      const Value<T> least = largest[kind(k)] * Value<T>(0x1p-26);
      return abs(value_of(y[k])) < least ? T(least) + (y[k] - T(value_of(y[k]))) : y[k];
    }
    void measure() {
      largest = {};
      for (std::size_t k = 0; k < y.size(); ++k)
        largest[kind(k)] = std::max(largest[kind(k)], Value<T>(abs(value_of(y[k]))));
    }
    // What the rates round, for the step of size h whose middle is at this time.
    void find_rounded(const P& p, const T& middle, const T& h) {
      sizes.resize(y.size());
      rounded.find(p.chart_field_tape(), middle, w);
      for (std::size_t k = 0; k < y.size(); ++k) sizes[k] = rounded.over(h, k);
    }
    // True where positions or momenta ended four times as far from the prediction as they and their predicted
    // change are large, and 2^-26 of what the forces are made of: at rest these cancel. At steps that are too
    // long the equation has solutions far away, which a secant can hit and which are not the motion.
    [[nodiscard]] bool on_another_branch(const P& p, const T& middle, const T& h) {
      std::array<Value<T>, 2> gone{}, expected = largest;
      for (std::size_t k = 0; k < y.size(); ++k) {
        gone[kind(k)] = std::max(gone[kind(k)], Value<T>(abs(value_of(d[k]) - predicted[k])));
        expected[kind(k)] = std::max(expected[kind(k)], Value<T>(abs(predicted[k])));
      }
      const auto far = [&] {
        return gone[0] > Value<T>(4) * expected[0] || gone[1] > Value<T>(4) * expected[1];
      };
      if (!far()) return false;
      find_rounded(p, middle, h);
      for (std::size_t k = 0; k < y.size(); ++k)
        expected[kind(k)] = std::max(expected[kind(k)],
                                     Value<T>((abs(value_of(reference(k))) + sizes[k]) * Value<T>(0x1p-26)));
      return far();
    }
    // w = y + d, with what the sums so far have rounded off.
    void place() {
      for (std::size_t k = 0; k < y.size(); ++k) w[k] = y[k] + (d[k] + carry[k]);
    }
    Status fail(Status status) {
      continuation.forget();
      return status;
    }
  };

  template <HasDarbouxChart P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    if (const Status status = start(p, t, h, z, w); status != Status::converged) return w.fail(status);
    w.gradient.set_step(t, h);
    Status status = iterate(p, t, h, w, first_iterations);
    if (status == Status::not_converged) status = begin_anew(p, t, h, w);
    if (status != Status::converged) return w.fail(status);
    if (w.on_another_branch(p, t + h / T(2), h)) return w.fail(Status::not_converged);

    if (!w.midpoint) w.gradient(w.w.data(), w.psi.data());
    for (std::size_t k = 0; k < w.y.size(); ++k) {
      const T rest = w.correction[k] - w.residual[k];
      w.change[k] = w.midpoint ? w.psi[k] + (rest + rest) : w.psi[k];
    }
    w.forecast.remember(w.change, [&w](std::size_t k) { return w.reference(k); });
    for (std::size_t k = 0; k < w.y.size(); ++k) add_to(w.y[k], w.carry[k], w.change[k], compensated);
    p.chart_inverse(t + h, w.y, z);
    w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

 private:
  // The first w = y + d, and the matrix that corrects it.
  template <class P>
  static Status start(const P& p, const Scalar<P>& t, const Scalar<P>& h, const State<P>& z, Work<P>& w) {
    using T = Scalar<P>;
    if (!w.continuation.holds(t, h, z)) {
      p.chart(t, z, w.y);
      for (T& x : w.carry) x = T(0);
      w.forecast.forget();
      w.contraction.forget();
    }
    w.measure();
    w.forecast.expect(
        p, t, h, w.y, [&w](std::size_t k) { return w.reference(k); }, w.change);
    for (std::size_t k = 0; k < w.y.size(); ++k) {
      w.d[k] = w.share.row(k, w.change.data());
      w.predicted[k] = value_of(w.d[k]);
    }
    w.place();
    if (!w.factors()) return Status::converged;
    ++p.counters().factorisations;
    return w.matrix.factor(p, t, h, w.share, w.y, w.w, w.change);
  }

  // What the equation lacks at w, and by how much to correct w.
  template <class P>
  static void find_correction(const P& p, const Scalar<P>& t, const Scalar<P>& h, Work<P>& w) {
    w.gradient(w.w.data(), w.psi.data());
    ++p.counters().iterations;
    p.counters().fields += static_cast<std::int64_t>(w.gradient.evaluations());
    for (std::size_t k = 0; k < w.y.size(); ++k) w.residual[k] = w.share.row(k, w.psi.data()) - w.d[k];
    correct(p, t, h, w);
  }

  // Iterates from w with secants, at most `limit` times.
  template <class P>
  static Status iterate(const P& p, const Scalar<P>& t, const Scalar<P>& h, Work<P>& w, int limit) {
    w.secants.forget();
    SecantConvergence<Scalar<P>> convergence;
    do {
      find_correction(p, t, h, w);
      if (w.factors()) w.secants.improve(w.correction, w.y, w.psi);
      convergence.begin_iteration();
      for (std::size_t k = 0; k < w.y.size(); ++k) {
        w.d[k] = w.d[k] + w.correction[k];
        convergence.add(w.correction[k], w.reference(k), w.psi[k]);
      }
      w.place();
    } while (!convergence.finished(limit, w.contraction.ratio()));
    if (convergence.status() == Status::converged) w.contraction.remember_slowest(convergence.contraction());
    return convergence.status();
  }

  // Begins anew without secants, as roundings teach them nothing and may have thrown w far away; where that
  // is in vain, with them. What leaves the range of numbers in this way has not converged.
  template <class P>
  [[gnu::noinline]] static Status begin_anew(const P& p, const Scalar<P>& t, const Scalar<P>& h, Work<P>& w) {
    const auto return_to_prediction = [&w] {
      for (std::size_t k = 0; k < w.y.size(); ++k) w.d[k] = Scalar<P>(w.predicted[k]);
      w.place();
    };
    return_to_prediction();
    w.find_rounded(p, t + h / Scalar<P>(2), h);
    w.rounding.resize(w.y.size());
    for (std::size_t k = 0; k < w.y.size(); ++k) w.rounding[k] = w.reference(k);
    add_rounding(w.rounding, w.sizes, w.residual, w.correction, [&] { correct(p, t, h, w); });
    const auto correct_once = [&] {
      find_correction(p, t, h, w);
      for (std::size_t k = 0; k < w.y.size(); ++k) w.d[k] = w.d[k] + w.correction[k];
      w.place();
      return Status::converged;
    };
    if (end_by_rounding(most_iterations, correct_once, w.correction, w.rounding, w.psi) == Status::converged)
      return Status::converged;
    return_to_prediction();
    const Status status = iterate(p, t, h, w, most_iterations);
    return status == Status::converged ? status : Status::not_converged;
  }

  // Solves (I - h P Y_y) correction = residual, with a matrix or without one.
  template <class P>
  static void correct(const P& p, const Scalar<P>& t, const Scalar<P>& h, Work<P>& w) {
    if (w.factors()) return w.matrix.solve(w.share, w.residual, w.correction);
    w.without_matrix.solve(
        p, t, h, w.share, w.w, w.residual, [&w](std::size_t k) { return w.reference(k); }, w.psi,
        w.correction);
  }
};

}  // namespace pfaff
