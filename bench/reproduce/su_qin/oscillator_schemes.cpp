// Su & Qin, section 5, (100)-(107): coefficients of the damped oscillator's generating function and its
// schemes, through the registered methods.
#include <array>
#include <cmath>

#include <pfaff/bench/reproduce/su_qin/oscillator.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/integrators/generating_expansion.hpp>

namespace pfaff::su_qin {

namespace {

using Entries = std::array<Quad, 4>;  // row-major

class OscillatorSchemes {
 public:
  std::vector<ReproducedRow> rows() {
    coefficients();
    schemes();
    return rows_.take();
  }

 private:
  Rows rows_{"5"};
  const Quad e0_ = exp(nu * t0);
  std::shared_ptr<const Model> model_ = damped("damped-oscillator");

  static Numbers list(const Entries& m) { return {m.begin(), m.end()}; }

  // (100), (104): coefficients of the generating function, as (R, P) components of phi_w^(k) at w = (R, P).
  [[nodiscard]] Numbers coefficient(int k, const Numbers& w) const {
    const Numbers in_chart = engine_term(*model_, k, {w[0], -w[1]});
    return {in_chart[0], -in_chart[1]};
  }

  void coefficients() {
    const Numbers w{Quad(0.6), Quad(0.3)};
    rows_.reproduced("(100)", "phi_w^(0)", {Quad(0), Quad(0)}, coefficient(0, w));
    rows_.reproduced("(100)", "phi_w^(1)", {-e0_ * w[0], -w[1] / e0_}, coefficient(1, w));
    rows_.reproduced("(104)", "phi_w^(2)", {-nu / Quad(2) * e0_ * w[0], nu / Quad(2) / e0_ * w[1]},
                     coefficient(2, w));
    // (101): w^ = phi_w^(1) tau is what the scheme of order 1 solves.
    const StepJacobian<Quad> step =
        step_of("generating-function", {{"order", "1"}, {"variant", "P"}}, model_, {Quad(0.5), Quad(0.1)});
    const Numbers a = alpha_of(*model_, step.z, {Quad(0.5), Quad(0.1)});
    rows_.reproduced("(101)", "w^ = tau phi_w^(1)(w)", {-tau * e0_ * a[2], -tau / e0_ * a[3]}, {a[0], a[1]});
    // (101) and (104) print phi^(k), a number, where its gradient stands: the gradient of the number that the
    // scalar equation gives is the vector printed.
    const Tape phi = expand_scalar(scalar_evolution(*model_->tape(Formula::chart_hamiltonian)), 2, 2)[2];
    const Numbers slope = value(jacobian_tape(phi), t0, {w[0], -w[1]});
    const double residual =
        distance({slope[0], -slope[1]}, {-nu / Quad(2) * e0_ * w[0], nu / Quad(2) / e0_ * w[1]});
    rows_.qualitative("(101), (104)", "phi^(k) for its gradient", "phi^(2) = (-nu/2 E0 R, ..)",
                      "phi_w^(2), phi^(2) = " + shown(value(phi, t0, {w[0], -w[1]})), residual, at_round_off,
                      residual <= at_round_off, "(101), (104): what is printed is phi_w^(k)");
  }

  static Quad determinant(const Entries& m) { return m[0] * m[3] - m[1] * m[2]; }

  // The transition matrix of (105) with a given numerator in the lower left.
  [[nodiscard]] Entries transition(Quad h, bool printed) const {
    const Quad a = Quad(2) * h - nu * h * h, b = Quad(2) * h + nu * h * h, e = exp(-(nu * h));
    const Quad d = Quad(16) + a * b, c = Quad(16) - a * b;
    return {c / d, Quad(8) * a / d, -Quad(8) * (printed ? a : b) * e / d, c * e / d};
  }
  // Local order: slope of |T(h) - exact(h)| less one.
  [[nodiscard]] double local_order(bool printed) const {
    const auto error = [&](Quad h) {
      return distance(list(transition(h, printed)), linear_flow<Quad>(*model_, h).entries());
    };
    return std::log10(error(Quad(1) / Quad(1000)) / error(Quad(1) / Quad(10000))) - 1;
  }

  void schemes() {
    const Numbers z{Quad(0.5), Quad(0.1)};
    const Quad e = exp(-(nu * tau)), s = Quad(4) + tau * tau;
    const Entries first{(Quad(4) - tau * tau) / s, Quad(4) * tau / s, -Quad(4) * tau / s * e,
                        (Quad(4) - tau * tau) / s * e};
    const auto one = step_of("generating-function", {{"order", "1"}, {"variant", "P"}}, model_, z);
    rows_.reproduced("(102)", "transition matrix, order 1", list(first), one.jacobian);
    Numbers k1(4), k0(4);
    const Problem<Quad> problem(model_);
    problem.structure(t1, z, k1);
    problem.structure(t0, z, k0);
    rows_.reproduced("(103)", "A^T K(t1) A = K(t0)", {Quad(0)}, {congruence_residual(one.jacobian, k1, k0)});

    const auto two = step_of("generating-function", {{"order", "2"}, {"variant", "P"}}, model_, z);
    rows_.erratum("(105)", "transition matrix, order 2, as printed", list(transition(tau, true)),
                  list(transition(tau, false)), two.jacobian, "(105): the lower left entry has b");
    const Quad off = abs(determinant(transition(tau, true)) - e);
    rows_.claim("(105)", "as printed: symplectic, of order 2", "det e^{-nu tau}, order 2",
                "det off by " + to_string(off, 3) + ", order " + to_string(Quad(local_order(true)), 3),
                static_cast<double>(off), local_order(true) < 1.9, "(105): the lower left entry has b");
    rows_.reproduced("(105)", "corrected", list(transition(tau, false)), two.jacobian);
    rows_.reproduced("(105)", "corrected: K-symplectic", {Quad(0)},
                     {congruence_residual(two.jacobian, k1, k0)});
    rows_.measured("(105)", "corrected: order", 2, local_order(false), 0.01);
    // (106): a and b are what the generating gradient's matrix at order 2 says: N = phi^(1) tau + phi^(2)
    // tau^2.
    const Numbers at{Quad(1), Quad(1)};
    const Numbers c1 = coefficient(1, at), c2 = coefficient(2, at);
    rows_.reproduced("(106)", "a, b", {Quad(2) * tau - nu * tau * tau, Quad(2) * tau + nu * tau * tau},
                     {-Quad(2) * e0_ * (c1[1] * tau + c2[1] * tau * tau),
                      -Quad(2) / e0_ * (c1[0] * tau + c2[0] * tau * tau)});

    const Quad d = tau * tau + Quad(2) * nu * tau + Quad(4);
    const Entries centre{(Quad(4) + Quad(2) * nu * tau - tau * tau) / d, Quad(4) * tau / d,
                         -Quad(4) * tau / d, (Quad(4) - Quad(2) * nu * tau - tau * tau) / d};
    const auto euler = step_of("implicit-midpoint", {}, model_, z);
    rows_.reproduced("(107)", "Euler centre scheme", list(centre), euler.jacobian);
    const Quad residual = congruence_residual(euler.jacobian, k1, k0);
    rows_.qualitative("(107)", "is not K-symplectic", "not symplectic", "residual " + to_string(residual, 3),
                      static_cast<double>(residual), clearly, static_cast<double>(residual) > clearly,
                      "the residual of A^T K A = K exceeds 1e-6");
  }
};

}  // namespace

std::vector<ReproducedRow> oscillator_schemes() { return OscillatorSchemes().rows(); }

}  // namespace pfaff::su_qin
