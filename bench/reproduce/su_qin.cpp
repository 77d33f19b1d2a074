// Su & Qin, section 5: the damped oscillator r'' + nu r' + r = 0, equations (92)-(107), rebuilt in quad
// through the same plug-ins that any other system uses, at nu = 3/10, t0 = 7/10, tau = 1/5. Printed formulas
// are evaluated as printed; where that contradicts the definitions, the row is an erratum, its entry in
// docs/errata.md named, and the corrected formula is shown to be ours.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <pfaff/bench/measure/structure.hpp>
#include <pfaff/bench/reproduce/reproduce.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/generating_gradient.hpp>

namespace pfaff {

namespace {

using Numbers = std::vector<Quad>;
using Matrix = std::array<Quad, 4>;  // row-major

constexpr double at_round_off = 1e-30;  // quad: 1e-34 a rounding, a few hundred of them

class SuQin {
 public:
  std::vector<ReproducedRow> rows() {
    birkhoffian_form();
    alpha();
    derivatives();
    coefficients();
    schemes();
    return std::move(rows_);
  }

 private:
  const Quad nu_{Quad(3) / Quad(10)}, t0_{Quad(7) / Quad(10)}, tau_{Quad(1) / Quad(5)};
  const Quad t_ = t0_ + tau_;
  const Quad e_ = exp(nu_ * t_), e0_ = exp(nu_ * t0_);
  std::shared_ptr<const Model> model_ = systems().get("damped-oscillator", "system").make({{"nu", "3/10"}});
  std::vector<ReproducedRow> rows_;

  static std::string shown(const Numbers& x) {
    std::string text;
    for (const Quad& v : x) {
      if (!text.empty()) text += ' ';
      text += to_string(v, 6);
    }
    return text;
  }
  static double distance(const Numbers& a, const Numbers& b) {
    Quad worst(0);
    for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, abs(a[k] - b[k]));
    return static_cast<double>(worst);
  }
  static Numbers list(const Matrix& m) { return {m.begin(), m.end()}; }
  void row(const std::string& equation, const std::string& what, const Numbers& printed,
           const Numbers& ours) {
    ReproducedRow r{equation + " " + what, "5",         equation,
                    shown(printed),        shown(ours), distance(printed, ours),
                    at_round_off,          "",          ""};
    r.status = r.difference <= at_round_off ? "reproduced" : "failed";
    rows_.push_back(r);
  }
  // A misprint: the printed value must differ from ours clearly, and the corrected one must not.
  void erratum(const std::string& equation, const std::string& what, const Numbers& printed,
               const Numbers& corrected, const Numbers& ours, const std::string& entry) {
    ReproducedRow r{equation + " " + what,   "5",          equation, shown(printed), shown(ours),
                    distance(printed, ours), at_round_off, "",       entry};
    r.status = r.difference > 1e-6 && distance(corrected, ours) <= at_round_off ? "erratum" : "failed";
    rows_.push_back(r);
  }

  // (92)-(94): K, its inverse, F, B and the equations of motion from the plug-in's one-form.
  void birkhoffian_form() {
    const Numbers z{Quad(0.4), Quad(-0.7)};
    const Problem<Quad> problem(model_);
    Numbers k(4), pi(4), f(2), x(2);
    problem.structure(t0_, z, k);
    problem.poisson_tensor(t0_, z, pi);
    problem.one_form(t0_, z, f);
    // The field from F and B alone, without the author's override.
    Replay<Quad>(model_->derived(Formula::field))(t0_, z.data(), x.data());
    row("(93)", "K z' = (nu E p + E r, E p)", {nu_ * e0_ * z[1] + e0_ * z[0], e0_ * z[1]},
        {k[0] * x[0] + k[1] * x[1], k[2] * x[0] + k[3] * x[1]});
    row("(94)", "K", {Quad(0), -e0_, e0_, Quad(0)}, k);
    row("(94)", "K^-1", {Quad(0), Quad(1) / e0_, -Quad(1) / e0_, Quad(0)}, pi);
    row("(94)", "F", {e0_ * z[1] / Quad(2), -(e0_ * z[0]) / Quad(2)}, f);
    const Quad half = e0_ / Quad(2), r2 = z[0] * z[0], rp = z[0] * z[1], p2 = z[1] * z[1];
    erratum("(94)", "B", {half * (r2 + rp + p2)}, {half * (r2 + nu_ * rp + p2)},
            {problem.birkhoffian(t0_, z)}, "(94): the middle term is nu r p");
  }

  // (95)-(98): alpha through the plug-in's chart, R^ = dy_p, P^ = dy_r, R = mean y_r, P = -mean y_p.
  Numbers alpha_of(const Numbers& hat, const Numbers& z) const {
    const Problem<Quad> problem(model_);
    Numbers y1(2), y0(2);
    problem.chart(t_, hat, y1);
    problem.chart(t0_, z, y0);
    return {y1[1] - y0[1], y1[0] - y0[0], (y1[0] + y0[0]) / Quad(2), -(y1[1] + y0[1]) / Quad(2)};
  }
  Numbers alpha_inverse(const Numbers& w) const {
    const Problem<Quad> problem(model_);
    const Quad two(2);
    const Numbers y1{w[2] + w[1] / two, -w[3] + w[0] / two}, y0{w[2] - w[1] / two, -w[3] - w[0] / two};
    Numbers hat(2), z(2);
    problem.chart_inverse(t_, y1, hat);
    problem.chart_inverse(t0_, y0, z);
    return {hat[0], hat[1], z[0], z[1]};
  }
  // alpha is linear here: its Jacobian column by column.
  static std::vector<Quad> columns(const std::function<Numbers(const Numbers&)>& map) {
    std::vector<Quad> m(16);
    for (std::size_t j = 0; j < 4; ++j) {
      Numbers unit(4);
      unit[j] = Quad(1);
      const Numbers column = map(unit);
      for (std::size_t i = 0; i < 4; ++i) m[i * 4 + j] = column[i];
    }
    return m;
  }

  void alpha() {
    const Numbers hat{Quad(0.3), Quad(-0.2)}, z{Quad(0.5), Quad(0.1)};
    const Quad half = Quad(1) / Quad(2), zero(0), one(1);
    row("(95)", "alpha",
        {e_ * hat[1] - e0_ * z[1], hat[0] - z[0], (hat[0] + z[0]) * half, -(e_ * hat[1] + e0_ * z[1]) * half},
        alpha_of(hat, z));
    const auto a = columns([&](const Numbers& x) { return alpha_of({x[0], x[1]}, {x[2], x[3]}); });
    row("(96)", "alpha_*",
        {zero, e_, zero, -e0_, one, zero, -one, zero, half, zero, half, zero, zero, -e_ * half, zero,
         -e0_ * half},
        a);
    // (34): alpha_*^T J_4n alpha_* = diag(K, -K0); (35) puts diag(J_2n, -J_2n) in the middle instead.
    const auto congruence = [&](const std::array<std::array<int, 4>, 4>& middle) {
      Numbers result(16);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t c = 0; c < 4; ++c)
              result[i * 4 + j] += a[r * 4 + i] * Quad(middle[r][c]) * a[c * 4 + j];
      return result;
    };
    const Numbers structure{zero, -e_,  zero, zero, e_,   zero, zero, zero,
                            zero, zero, zero, e0_,  zero, zero, -e0_, zero};
    const auto j4 = congruence({{{0, 0, 1, 0}, {0, 0, 0, 1}, {-1, 0, 0, 0}, {0, -1, 0, 0}}});
    row("(34)", "alpha_*^T J alpha_* = diag(K, -K0) for (95)", structure, j4);
    erratum("(35)", "the middle matrix",
            congruence({{{0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 0, -1}, {0, 0, 1, 0}}}), j4, structure,
            "(35): the middle matrix is J_4n");
    const Numbers w{Quad(0.2), Quad(-0.4), Quad(0.6), Quad(0.3)};
    const Numbers inverse{w[2] + w[1] * half, (w[0] * half - w[3]) / e_, w[2] - w[1] * half,
                          -(w[0] * half + w[3]) / e0_};
    Numbers printed = inverse;
    printed[3] = -(half * e0_ * w[0]) - w[3] / e0_;
    erratum("(97)", "alpha^-1", printed, inverse, alpha_inverse(w), "(97): p has e^{-nu t0} in front of R^");
    row("(98)", "alpha_*^-1",
        {zero, half, one, zero, half / e_, zero, zero, -one / e_, zero, -half, one, zero, -half / e0_, zero,
         zero, -one / e0_},
        columns([&](const Numbers& x) { return alpha_inverse(x); }));
  }

  // (99): the total time derivatives of w^ and w at fixed z, as functions of (w^, w).
  void derivatives() {
    const Numbers w{Quad(0.2), Quad(-0.4), Quad(0.6), Quad(0.3)}, z = alpha_inverse(w);
    const Numbers hat{z[0], z[1]};
    const Problem<Quad> problem(model_);
    Numbers y(2), rate(2);
    problem.chart(t_, hat, y);
    Replay<Quad>(model_->tape(Formula::chart_field))(t_, y.data(), rate.data());
    const Quad half = Quad(1) / Quad(2);
    row("(99)", "dw^/dt, dw/dt",
        {-half * e_ * w[1] - e_ * w[2], half / e_ * w[0] - w[3] / e_,
         half * half / e_ * w[0] - half / e_ * w[3], half * half * e_ * w[1] + half * e_ * w[2]},
        {rate[1], rate[0], rate[0] * half, -rate[1] * half});
  }

  // (100), (104): coefficients of the generating function, as (R, P) components of phi_w^(k) at w = (R, P).
  Numbers coefficient(int k, const Numbers& w) const {
    GeneratingGradient<Quad> gradient(model_->tape(Formula::chart_field), std::max(k, 1), false,
                                      GeneratingForm::midpoint, gauss_coefficients((std::max(k, 1) + 1) / 2));
    gradient.set_step(t0_, tau_);
    const Numbers y{w[0], -w[1]};
    Numbers terms(gradient.term_count() * 2);
    gradient.terms(y.data(), terms.data());
    Quad power(1);
    for (int i = 0; i < k; ++i) power *= tau_;
    const auto at = static_cast<std::size_t>(k) * 2;
    return {terms[at + 1] / power, terms[at] / power};
  }

  void coefficients() {
    const Numbers w{Quad(0.6), Quad(0.3)};
    row("(100)", "phi_w^(0)", {Quad(0), Quad(0)}, coefficient(0, w));
    row("(100)", "phi_w^(1)", {-e0_ * w[0], -w[1] / e0_}, coefficient(1, w));
    row("(104)", "phi_w^(2)", {-nu_ / Quad(2) * e0_ * w[0], nu_ / Quad(2) / e0_ * w[1]}, coefficient(2, w));
    // (101): w^ = phi_w^(1) tau is what the scheme of order 1 solves.
    const StepJacobian<Quad> step =
        step_of("generating-function", {{"order", "1"}, {"variant", "P"}}, {Quad(0.5), Quad(0.1)});
    const Numbers a = alpha_of(step.z, {Quad(0.5), Quad(0.1)});
    row("(101)", "w^ = tau phi_w^(1)(w)", {-tau_ * e0_ * a[2], -tau_ / e0_ * a[3]}, {a[0], a[1]});
  }

  StepJacobian<Quad> step_of(const std::string& name, const Assignments& parameters, const Numbers& z) const {
    const auto method = integrators().get(name, "integrator").make(parameters);
    return StepDifferentiator<Quad>(*method, model_)(t0_, tau_, z);
  }
  static Quad determinant(const Matrix& m) { return m[0] * m[3] - m[1] * m[2]; }

  // The transition matrix of (105) with a given numerator in the lower left.
  [[nodiscard]] Matrix transition(Quad h, bool printed) const {
    const Quad a = Quad(2) * h - nu_ * h * h, b = Quad(2) * h + nu_ * h * h, e = exp(-(nu_ * h));
    const Quad d = Quad(16) + a * b, c = Quad(16) - a * b;
    return {c / d, Quad(8) * a / d, -Quad(8) * (printed ? a : b) * e / d, c * e / d};
  }
  [[nodiscard]] Matrix exact(Quad h) const {
    const Problem<Quad> problem(model_);
    Matrix m{};
    for (std::size_t j = 0; j < 2; ++j) {
      Numbers z{Quad(j == 0 ? 1 : 0), Quad(j == 1 ? 1 : 0), t0_}, out(2);
      problem.exact_solution(h, z, out);
      m[j] = out[0];
      m[2 + j] = out[1];
    }
    return m;
  }
  // Local order: slope of |T(h) - exact(h)| less one.
  [[nodiscard]] double local_order(bool printed) const {
    const auto error = [&](Quad h) { return distance(list(transition(h, printed)), list(exact(h))); };
    return std::log10(error(Quad(1) / Quad(1000)) / error(Quad(1) / Quad(10000))) - 1;
  }

  void schemes() {
    const Numbers z{Quad(0.5), Quad(0.1)};
    const Quad e = exp(-(nu_ * tau_)), s = Quad(4) + tau_ * tau_;
    const Matrix first{(Quad(4) - tau_ * tau_) / s, Quad(4) * tau_ / s, -Quad(4) * tau_ / s * e,
                       (Quad(4) - tau_ * tau_) / s * e};
    const auto one = step_of("generating-function", {{"order", "1"}, {"variant", "P"}}, z);
    row("(102)", "transition matrix, order 1", list(first), one.jacobian);
    Numbers k1(4), k0(4);
    const Problem<Quad> problem(model_);
    problem.structure(t_, z, k1);
    problem.structure(t0_, z, k0);
    row("(103)", "A^T K(t1) A = K(t0)", {Quad(0)}, {congruence_residual(one.jacobian, k1, k0)});

    const auto two = step_of("generating-function", {{"order", "2"}, {"variant", "P"}}, z);
    erratum("(105)", "transition matrix, order 2, as printed", list(transition(tau_, true)),
            list(transition(tau_, false)), two.jacobian, "(105): the lower left entry has b");
    {
      const double slope = local_order(true);
      const Quad det = determinant(transition(tau_, true));
      ReproducedRow r{"(105) as printed: symplectic, of order 2",
                      "5",
                      "(105)",
                      "det e^{-nu tau}, order 2",
                      "det off by " + to_string(abs(det - e), 3) + ", order " + to_string(Quad(slope), 3),
                      static_cast<double>(abs(det - e)),
                      at_round_off,
                      "",
                      "(105): the lower left entry has b"};
      r.status = r.difference > 1e-6 && slope < 1.9 ? "erratum" : "failed";
      rows_.push_back(r);
    }
    row("(105)", "corrected", list(transition(tau_, false)), two.jacobian);
    row("(105)", "corrected: K-symplectic", {Quad(0)}, {congruence_residual(two.jacobian, k1, k0)});
    {
      const double slope = local_order(false);
      ReproducedRow r{"(105) corrected: order 2", "5",  "(105)", "2", to_string(Quad(slope), 4),
                      std::abs(slope - 2),        0.01, "",      ""};
      r.status = r.difference <= r.tolerance ? "reproduced" : "failed";
      rows_.push_back(r);
    }
    // (106): a and b are what the generating gradient's matrix at order 2 says: N = phi^(1) tau + phi^(2)
    // tau^2.
    const Numbers at{Quad(1), Quad(1)};
    const Numbers c1 = coefficient(1, at), c2 = coefficient(2, at);
    row("(106)", "a, b", {Quad(2) * tau_ - nu_ * tau_ * tau_, Quad(2) * tau_ + nu_ * tau_ * tau_},
        {-Quad(2) * e0_ * (c1[1] * tau_ + c2[1] * tau_ * tau_),
         -Quad(2) / e0_ * (c1[0] * tau_ + c2[0] * tau_ * tau_)});

    const Quad d = tau_ * tau_ + Quad(2) * nu_ * tau_ + Quad(4);
    const Matrix centre{(Quad(4) + Quad(2) * nu_ * tau_ - tau_ * tau_) / d, Quad(4) * tau_ / d,
                        -Quad(4) * tau_ / d, (Quad(4) - Quad(2) * nu_ * tau_ - tau_ * tau_) / d};
    const auto euler = step_of("implicit-midpoint", {}, z);
    row("(107)", "Euler centre scheme", list(centre), euler.jacobian);
    {
      const Quad residual = congruence_residual(euler.jacobian, k1, k0);
      ReproducedRow r{"(107) is not K-symplectic",
                      "5",
                      "(107)",
                      "not symplectic",
                      "residual " + to_string(residual, 3),
                      static_cast<double>(residual),
                      1e-6,
                      "",
                      "the residual of A^T K A = K exceeds 1e-6"};
      r.status = residual > Quad(1e-6) ? "qualitative" : "failed";
      rows_.push_back(r);
    }
  }
};

}  // namespace

std::vector<ReproducedRow> reproduce_su_qin() { return SuQin().rows(); }

}  // namespace pfaff
