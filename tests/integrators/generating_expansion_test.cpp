// The terms tau^k phi_w^(k) that the engine computes, against the theory written out literally: the recursion
// by total derivatives, the multilinear expansion (su-qin (77)-(78) corrected), the scalar Hamilton-Jacobi
// form, and closed forms.
#include <gtest/gtest.h>

#include <pfaff/core/system.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/integrators/generating/generating_gradient.hpp>
#include <pfaff/tests/generating/generating_expansion.hpp>

#include "bent.hpp"
#include "generating_samples.hpp"

namespace pfaff {
namespace {

using testing::at_round_off;
using testing::bent;
using testing::distance;
using testing::Numbers;
using testing::start_time;
using testing::values;
using Arguments = std::span<const Recorded>;
using Results = std::span<Recorded>;

// phi_w^(k) = -K_c psi^(k) = (psi_p, -psi_q) of the engine.
Numbers engine(const Model& model, int k, Quad t0, const Numbers& w) {
  GeneratingGradient<Quad> gradient(model.tape(Formula::chart_field), k, false, GeneratingForm::midpoint,
                                    gauss_coefficients((k + 1) / 2));
  gradient.set_step(t0, Quad(1));
  const std::size_t n = w.size(), half = n / 2;
  Numbers terms(gradient.term_count() * n), result(n);
  gradient.terms(w.data(), terms.data());
  for (std::size_t i = 0; i < half; ++i) {
    result[i] = terms[static_cast<std::size_t>(k) * n + half + i];
    result[half + i] = -terms[static_cast<std::size_t>(k) * n + i];
  }
  return result;
}

std::shared_ptr<const Model> damped_model(const char* name) {
  return systems().get(name, "system").make({{"nu", "0.3"}});
}
const Numbers point{Quad(6) / Quad(10), Quad(-3) / Quad(10)};

TEST(GeneratingExpansion, TotalDerivativesAgreeWithTheEngine) {
  for (const auto& model : {damped_model("damped-oscillator"), damped_model("damped-pendulum"), bent()}) {
    const Tape rate = evolution(*model, chart_alpha(*model));
    const auto terms = expand_gradient(rate, 2, 5, ExpansionRule::total_derivative);
    for (int k = 1; k <= 5; ++k)
      EXPECT_LE(distance(values(terms[static_cast<std::size_t>(k)], start_time, point),
                         engine(*model, k, start_time, point)),
                at_round_off)
          << model->name() << " k " << k;
  }
}

TEST(GeneratingExpansion, CorrectedMultilinearExpansionAgreesWithTheEngine) {
  for (const auto& model : {damped_model("damped-oscillator"), damped_model("damped-pendulum"), bent()}) {
    const Tape rate = evolution(*model, chart_alpha(*model));
    const auto terms = expand_gradient(rate, 2, 5, ExpansionRule::multilinear);
    for (int k = 1; k <= 5; ++k)
      EXPECT_LE(distance(values(terms[static_cast<std::size_t>(k)], start_time, point),
                         engine(*model, k, start_time, point)),
                at_round_off)
          << model->name() << " k " << k;
  }
}

TEST(GeneratingExpansion, BothAgreeWithTheEngineInFourDimensions) {
  const auto model = systems().get("henon-heiles", "system").make({});
  const Tape rate = evolution(*model, chart_alpha(*model));
  const Numbers w{Quad(0.1), Quad(-0.3), Quad(0.25), Quad(0.2)};
  for (const auto rule : {ExpansionRule::total_derivative, ExpansionRule::multilinear}) {
    const auto terms = expand_gradient(rate, 4, 4, rule);
    for (int k = 1; k <= 4; ++k)
      EXPECT_LE(distance(values(terms[static_cast<std::size_t>(k)], start_time, w),
                         engine(*model, k, start_time, w)),
                at_round_off)
          << k;
  }
}

TEST(GeneratingExpansion, PrintedExpansionDoesNot) {  // control
  const auto oscillator = damped_model("damped-oscillator");
  const auto printed =
      expand_gradient(evolution(*oscillator, chart_alpha(*oscillator)), 2, 2, ExpansionRule::printed_78);
  EXPECT_LE(distance(values(printed[1], start_time, point), engine(*oscillator, 1, start_time, point)),
            at_round_off);
  // It says phi_w^(2) = 0 for the oscillator, which (104) contradicts.
  EXPECT_LE(distance(values(printed[2], start_time, point), {Quad(0), Quad(0)}), at_round_off);
  EXPECT_GT(distance(engine(*oscillator, 2, start_time, point), {Quad(0), Quad(0)}), 1e-2);

  const auto model = bent();
  const auto other = expand_gradient(evolution(*model, chart_alpha(*model)), 2, 4, ExpansionRule::printed_78);
  for (int k = 2; k <= 4; ++k)
    EXPECT_GT(distance(values(other[static_cast<std::size_t>(k)], start_time, point),
                       engine(*model, k, start_time, point)),
              1e-3)
        << k;
}

// phi_t = -H(w - K_c^-1 phi_w/2, t), in two and in four dimensions.
TEST(GeneratingExpansion, GradientOfTheScalarFormAgreesWithTheEngine) {
  const auto expect = [](const Model& model, const Tape& hamiltonian, const Numbers& w, int degree) {
    const auto scalar = expand_scalar(scalar_evolution(hamiltonian), model.dimension(), degree);
    for (int k = 1; k <= degree; ++k) {
      const Tape& phi = scalar[static_cast<std::size_t>(k)];
      const Tape slope =
          record(model.dimension(), model.dimension(), [&](const Recorded& t, Arguments x, Results out) {
            const auto g = gradient(phi, t, x, std::vector<Recorded>{Recorded(1)});
            std::copy(g.begin(), g.end(), out.begin());
          });
      EXPECT_LE(distance(values(slope, start_time, w), engine(model, k, start_time, w)), at_round_off)
          << model.name() << " k " << k;
    }
  };
  for (const char* name : {"damped-oscillator", "damped-pendulum"}) {
    const auto model = damped_model(name);
    expect(*model, *model->tape(Formula::chart_hamiltonian), point, 6);
  }
  const auto henon = systems().get("henon-heiles", "system").make({});
  expect(*henon, *henon->tape(Formula::hamiltonian), {Quad(0.1), Quad(-0.3), Quad(0.25), Quad(0.2)}, 5);
}

// Through F, B and alpha instead of the chart's Hamiltonian: phi_t = -[B(z', t) + w^.d_t alpha_2 - S_t]. The
// exact part S is first shown to be one: w^.dw = F(z', t).dz' - F(z, t0).dz + dS.
TEST(GeneratingExpansion, ScalarFormFromTheBirkhoffianAndAlpha) {
  for (const char* name : {"damped-oscillator", "damped-pendulum"}) {
    const auto model = damped_model(name);
    const AlphaTapes alpha = chart_alpha(*model);
    const auto form = model->tape(Formula::one_form);
    // S = (E p' r - E0 p r')/2.
    const auto exact_part = [](int sign) {
      return record(5, 1, [sign](const Recorded& t, Arguments x, Results out) {
        const Recorded nu(0.3_r);
        out[0] = Recorded(sign) * (exp(nu * t) * x[1] * x[2] - exp(nu * x[4]) * x[3] * x[0]) / Recorded(2);
      });
    };
    const auto defect = [&](const Tape& exact) {
      const Tape difference = record(5, 4, [&](const Recorded& t, Arguments x, Results out) {
        const auto pair = evaluate(alpha.forward, t, x);
        const auto slope = jacobian(alpha.forward, t, x);
        const auto after = evaluate(*form, t, x.first(2)), before = evaluate(*form, x[4], x.subspan(2, 2));
        const auto ds = gradient(exact, t, x, std::vector<Recorded>{Recorded(1)});
        for (std::size_t i = 0; i < 4; ++i) {
          out[i] = -ds[i] - (i < 2 ? after[i] : -before[i - 2]);
          for (std::size_t j = 0; j < 2; ++j) out[i] = out[i] + pair[j] * slope[(2 + j) * 5 + i];
        }
      });
      const Numbers x{Quad(0.4), Quad(-0.2), Quad(0.3), Quad(0.7), start_time};
      return distance(values(difference, start_time + Quad(0.2), x), Numbers(4));
    };
    EXPECT_LE(defect(exact_part(1)), at_round_off);
    EXPECT_GT(defect(exact_part(-1)), 1e-3);  // control

    const auto from_b = expand_scalar(scalar_evolution(*model, alpha, exact_part(1)), 2, 4);
    const auto from_h = expand_scalar(scalar_evolution(*model->tape(Formula::chart_hamiltonian)), 2, 4);
    const auto wrong = expand_scalar(scalar_evolution(*model, alpha, exact_part(-1)), 2, 1);
    for (std::size_t k = 1; k <= 4; ++k)
      EXPECT_LE(distance(values(from_b[k], start_time, point), values(from_h[k], start_time, point)),
                at_round_off)
          << k;
    EXPECT_GT(distance(values(wrong[1], start_time, point), values(from_h[1], start_time, point)), 1e-3);
  }
}

// phi1..phi4 of the damped pendulum in closed form, s = sin R, c = cos R at t0 = 0; general t0 by scaling:
// phi(R, P; t0) = E0 phi(R, P/E0; 0). The chart's w is (R, -P) and the sign of P drops out but in phi3.
TEST(GeneratingExpansion, ClosedFormsOfTheDampedPendulum) {
  const auto model = damped_model("damped-pendulum");
  const auto scalar = expand_scalar(scalar_evolution(*model->tape(Formula::chart_hamiltonian)), 2, 4);
  const Quad nu = Quad(3) / Quad(10), e0 = exp(nu * start_time), r = point[0], p = -point[1] / e0;
  const Quad s = sin(r), c = cos(r);
  const auto q = [](int a, int b) { return Quad(a) / Quad(b); };
  const Numbers closed{Quad(0), c - p * p / Quad(2), nu * c / Quad(2) + nu * p * p / Quad(4),
                       -(c * p * p) / Quad(24) - s * s / Quad(24) + nu * p * s / Quad(6) -
                           nu * nu * p * p / Quad(12) + nu * nu * c / Quad(6),
                       nu * c * p * p / Quad(48) - nu * s * s / Quad(48) + nu * nu * nu * p * p / Quad(48) +
                           q(1, 24) * nu * nu * nu * c};
  for (std::size_t k = 1; k <= 4; ++k)
    EXPECT_LE(distance(values(scalar[k], start_time, point), {e0 * closed[k]}), at_round_off) << k;
}

// General closed forms: phi1 = -H, phi2 = -H_t/2, phi3 = -(1/3)[H_tt/2 + H_yt.f/4 + f^T H_yy f/8], f = J H_y.
TEST(GeneratingExpansion, ClosedFormsOfAnyHamiltonian) {
  const auto model = damped_model("damped-pendulum");
  const auto h = model->tape(Formula::chart_hamiltonian), field = model->tape(Formula::chart_field);
  const Tape h_t = record(
      2, 1, [&](const Recorded& t, Arguments y, Results out) { out[0] = time_derivative(*h, t, y)[0]; });
  const Tape closed = record(2, 3, [&](const Recorded& t, Arguments y, Results out) {
    const auto f = evaluate(*field, t, y);
    const Tape along = record(4, 1, [&](const Recorded& time, Arguments x, Results slope) {
      slope[0] = directional_derivative(*h, time, Recorded(0), x.first(2), x.subspan(2))[0];
    });
    const std::vector<Recorded> x{y[0], y[1], f[0], f[1]}, d{f[0], f[1], Recorded(0), Recorded(0)};
    out[0] = -evaluate(*h, t, y)[0];
    out[1] = -evaluate(h_t, t, y)[0] / Recorded(2);
    out[2] = -(time_derivative(h_t, t, y)[0] / Recorded(2) +
               directional_derivative(h_t, t, Recorded(0), y, f)[0] / Recorded(4) +
               directional_derivative(along, t, Recorded(0), x, d)[0] / Recorded(8)) /
             Recorded(3);
  });
  const auto scalar = expand_scalar(scalar_evolution(*h), 2, 3);
  const Numbers expected = values(closed, start_time, point);
  for (std::size_t k = 1; k <= 3; ++k)
    EXPECT_LE(distance(values(scalar[k], start_time, point), {expected[k - 1]}), at_round_off) << k;
}

// About the middle of the step: phi = -tau H - tau^3/24 [H_tt + 2 H_yt.f + f^T H_yy f] + O(tau^5), even parts
// absent.
TEST(GeneratingExpansion, ClosedFormsAboutTheMiddleOfTheStep) {
  const auto model = damped_model("damped-pendulum");
  const auto h = model->tape(Formula::chart_hamiltonian), field = model->tape(Formula::chart_field);
  const Tape h_t = record(
      2, 1, [&](const Recorded& t, Arguments y, Results out) { out[0] = time_derivative(*h, t, y)[0]; });
  const Tape closed = record(2, 2, [&](const Recorded& t, Arguments y, Results out) {
    const auto f = evaluate(*field, t, y);
    const Tape along = record(4, 1, [&](const Recorded& time, Arguments x, Results slope) {
      slope[0] = directional_derivative(*h, time, Recorded(0), x.first(2), x.subspan(2))[0];
    });
    const std::vector<Recorded> x{y[0], y[1], f[0], f[1]}, d{f[0], f[1], Recorded(0), Recorded(0)};
    out[0] = -evaluate(*h, t, y)[0];
    out[1] =
        -(time_derivative(h_t, t, y)[0] + Recorded(2) * directional_derivative(h_t, t, Recorded(0), y, f)[0] +
          directional_derivative(along, t, Recorded(0), x, d)[0]) /
        Recorded(24);
  });
  const Quad tau = Quad(1) / Quad(5), middle = start_time + tau / Quad(2);
  GeneratingGradient<Quad> gradient(model->tape(Formula::chart_field), 4, true, GeneratingForm::midpoint,
                                    gauss_coefficients(2));
  gradient.set_step(start_time, tau);
  Numbers terms(gradient.term_count() * 2);
  gradient.terms(point.data(), terms.data());
  const Numbers slope = values(jacobian_tape(closed), middle, point);  // rows: the gradients of chi1, chi3
  const Quad cube = tau * tau * tau;
  EXPECT_LE(distance({terms[3], -terms[2]}, {tau * slope[0], tau * slope[1]}), at_round_off);
  EXPECT_LE(distance({terms[7], -terms[6]}, {cube * slope[2], cube * slope[3]}), at_round_off);
  EXPECT_EQ(terms[4], Quad(0));
  EXPECT_EQ(terms[5], Quad(0));
  // Control: at the start of the step the second coefficient is not 0.
  EXPECT_GT(distance(engine(*model, 2, start_time, point), Numbers(2)), 1e-2);
}

}  // namespace
}  // namespace pfaff
