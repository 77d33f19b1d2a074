// Su & Qin, section 5, (100)-(107): coefficients of the damped oscillator's generating function and its
// schemes, through the registered methods.
#include <cmath>
#include <functional>

#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/integrators/generating/lagrangian_transformation.hpp>
#include <pfaff/papers/printed/generating.hpp>
#include <pfaff/papers/printed/oscillator.hpp>
#include <pfaff/papers/su_qin/rows.hpp>

namespace pfaff::su_qin {

namespace {

class OscillatorSchemes {
 public:
  explicit OscillatorSchemes(Rows& rows) : rows_(rows) {}
  void add() {
    coefficients();
    first_order();
    second_order();
    centre();
    best();
  }

 private:
  Rows& rows_;
  printed::Oscillator printed_{nu, t0, t1};
  std::shared_ptr<const Model> model_ = damped("damped-oscillator");
  Numbers z_{Quad(0.5), Quad(0.1)};
  Matrix<Quad> k1_ = structure(*model_, t1, z_);

  [[nodiscard]] StepJacobian<Quad> step(int order) const {
    return step_of("generating-function",
                   {{"order", std::to_string(order)}, {"variant", "P"}, {"extra", "0"}}, model_, z_);
  }
  // M^T K(t1) M of a step.
  [[nodiscard]] Numbers kept(const StepJacobian<Quad>& step) const {
    const Matrix<Quad> m(2, step.jacobian);
    return (m.transposed() * k1_ * m).entries();
  }
  // The engine's coefficients, as (R, P) components of phi_w^(k) at w = (R, P): the chart's P has the other
  // sign.
  [[nodiscard]] Numbers coefficient(int k, const Numbers& w) const {
    const Numbers in_chart = engine_term(*model_, k, {w[0], -w[1]});
    return {in_chart[0], -in_chart[1]};
  }

  void coefficients() {
    const Numbers w{Quad(0.6), Quad(0.3)};
    rows_.reproduced("(100)", "phi_w^(0)", printed_.coefficient(0, w), coefficient(0, w));
    rows_.reproduced("(100)", "phi_w^(1)", printed_.coefficient(1, w), coefficient(1, w));
    rows_.reproduced("(104)", "phi_w^(2)", printed_.coefficient(2, w), coefficient(2, w));
    // (101) and (104) print phi^(k), a number, where its gradient stands: the gradient of the number that the
    // scalar equation gives is the vector printed.
    // phi_t = -H with H = (e^{-nu t} y_1^2 + e^{nu t} y_0^2)/2.
    const auto phi = printed::coefficients(2, 2, [](const std::vector<printed::TauSeries>& shift) {
      printed::TauSeries r = shift[0], p = shift[1];
      r[0] = r[0] + printed::TrigonometricPolynomial::variable(0);
      p[0] = p[0] + printed::TrigonometricPolynomial::variable(1);
      return (Quad(1) / Quad(2)) * (printed::exponential(-nu, t0, r.size()) * p * p +
                                    printed::exponential(nu, t0, r.size()) * r * r);
    })[2];
    const Numbers in_chart{w[0], -w[1]}, slope{phi.slope(0).at(in_chart), phi.slope(1).at(in_chart)};
    rows_.qualitative(
        "(101), (104)", "phi^(k) for its gradient",
        {"phi^(2) = (-nu/2 E0 R, ..)", "phi_w^(2), phi^(2) = " + shown(Numbers{phi.at(in_chart)})},
        {at_most(distance({slope[0], -slope[1]}, printed_.coefficient(2, w)), at_round_off)},
        "(101), (104): what is printed is phi_w^(k)");
    // (106): a and b are what the gradient's matrix at order 2 says, N = phi_w^(1) tau + phi_w^(2) tau^2.
    const Numbers c1 = coefficient(1, {Quad(1), Quad(1)}), c2 = coefficient(2, {Quad(1), Quad(1)});
    const Quad e0 = exp(nu * t0);
    rows_.reproduced(
        "(106)", "a, b", {printed_.a(), printed_.b()},
        {-(2 * e0 * (c1[1] * tau + c2[1] * tau * tau)), -(2 / e0 * (c1[0] * tau + c2[0] * tau * tau))});
  }

  void first_order() {
    const auto one = step(1);
    // (101): w^ = phi_w^(1)(w) tau on the step, w^ by the engine from the alpha of a plug-in.
    LagrangianTransformation<Quad> alpha(damped("damped-pendulum")->tape(Formula::alpha));
    const Numbers w_hat = part(alpha(t1, t0, one.z, z_), 0, 2);
    rows_.reproduced("(101)", "w^ = tau phi_w^(1)(w)",
                     printed_.gradient(1, part(printed_.alpha(one.z, z_), 2, 2)), w_hat);
    rows_.reproduced("(102)", "transition matrix, order 1", printed::listed(printed_.first_order()),
                     one.jacobian);
    rows_.order("(102)", "order", 1, local_order([](const auto& o) { return o.first_order(); }), 0.01);
    rows_.reproduced("(103)", "A^T K(t1) A = K(t0)", printed::listed(printed_.k0()), kept(one));
  }

  // Local order of a transition matrix: slope of |T(h) - exact(h)| less one.
  [[nodiscard]] double local_order(
      const std::function<printed::Table<Quad>(const printed::Oscillator&)>& transition) const {
    const auto error = [&](const Quad& h) {
      return distance(printed::listed(transition(printed::Oscillator(nu, t0, t0 + h))),
                      linear_flow<Quad>(*model_, h).entries());
    };
    return std::log10(error(Quad(1) / 1000) / error(Quad(1) / 10000)) - 1;
  }

  void second_order() {
    const auto two = step(2);
    const auto as_printed = printed_.second_order(printed::Form::as_printed),
               corrected = printed_.second_order(printed::Form::corrected);
    rows_.erratum("(105)", "transition matrix, order 2, as printed", printed::listed(as_printed),
                  printed::listed(corrected), two.jacobian, "(105): the lower left entry has b");
    const double wrong = local_order([](const auto&o) { return o.second_order(printed::Form::as_printed); }),
                 right = local_order([](const auto&o) { return o.second_order(printed::Form::corrected); });
    const auto off = static_cast<double>(abs(printed::determinant(as_printed) - exp(-(nu * tau))));
    rows_.claim("(105)", "as printed: symplectic, of order 2",
                {"det e^{-nu tau}, order 2", "det off by " + shown(off) + ", order " + shown(wrong)},
                {at_least(off, clearly), at_most(wrong, 1.9)}, "(105): the lower left entry has b");
    rows_.reproduced("(105)", "corrected", printed::listed(corrected), two.jacobian);
    rows_.reproduced("(105)", "corrected: K-symplectic", printed::listed(printed_.k0()), kept(two));
    rows_.order("(105)", "corrected: order", 2, right, 0.01);
  }

  void centre() {
    const auto euler = step_of("implicit-midpoint", {}, model_, z_);
    rows_.reproduced("(107)", "Euler centre scheme", printed::listed(printed_.centre()), euler.jacobian);
    const double residual = leaves(euler);
    rows_.qualitative("(107)", "is not K-symplectic", {"not symplectic", "residual " + shown(residual)},
                      {at_least(residual, clearly)}, "the residual of A^T K A = K exceeds 1e-6");
  }

  // By how much a step leaves A^T K A = K.
  [[nodiscard]] double leaves(const StepJacobian<Quad>& step) const {
    return distance(kept(step), printed::listed(printed_.k0()));
  }

  // The paper prefers none. Over many steps the errors of (105) and (107) are alike, so that the order and
  // what is kept decide.
  void best() {
    const double first = local_order([](const auto&o) { return o.first_order(); }),
                 second = local_order([](const auto&o) { return o.second_order(printed::Form::corrected); });
    const double lost = leaves(step_of("implicit-midpoint", {}, model_, z_));
    rows_.qualitative("(107), (105), (102)", "which scheme is best", {"not said", "(105)"},
                      {at_most(leaves(step(2)), at_round_off), at_least(second, 1.99), at_most(first, 1.01),
                       at_least(lost, clearly)},
                      "(105), corrected: it alone is of order 2 and keeps K; (102) is of order 1, "
                      "and (107) does not keep K");
  }
};

}  // namespace

void oscillator_schemes(Rows& rows) { OscillatorSchemes(rows).add(); }

}  // namespace pfaff::su_qin
