// Su & Qin, section 4, (77)-(91): the coefficients of the generating function (Theorem 4.2), from the engine
// that the schemes use, and the order of the schemes (Theorem 4.3), measured.
#include <cmath>

#include <pfaff/bench/reproduce/su_qin/rows.hpp>
#include <pfaff/bench/verification/check.hpp>
#include <pfaff/integrators/generating_expansion.hpp>

namespace pfaff::su_qin {

namespace {

const Numbers at{Quad(0.6), Quad(-0.3)};

Numbers terms(const std::vector<Tape>& tapes, int first, int last) {
  Numbers all;
  for (int k = first; k <= last; ++k) all = joined(all, value(tapes[static_cast<std::size_t>(k)], t0, at));
  return all;
}
Numbers engine_terms(const Model& model, int first, int last) {
  Numbers all;
  for (int k = first; k <= last; ++k) all = joined(all, engine_term(model, k, at));
  return all;
}

void coefficients(Rows& rows) {
  const auto oscillator = damped("damped-oscillator"), pendulum = damped("damped-pendulum");
  const Tape linear = evolution(*oscillator, chart_alpha(*oscillator));
  const Tape nonlinear = evolution(*pendulum, chart_alpha(*pendulum));
  const auto printed_linear = expand_gradient(linear, 2, 2, ExpansionRule::as_printed);
  const auto corrected_linear = expand_gradient(linear, 2, 2, ExpansionRule::multilinear);
  const auto printed = expand_gradient(nonlinear, 2, 4, ExpansionRule::as_printed);
  const auto corrected = expand_gradient(nonlinear, 2, 5, ExpansionRule::multilinear);
  const auto total = expand_gradient(nonlinear, 2, 5, ExpansionRule::total_derivative);

  rows.reproduced("(80), (81)", "phi_w^(0), phi_w^(1), damped pendulum",
                  joined(Numbers(2), terms(corrected, 1, 1)), engine_terms(*pendulum, 0, 1));
  rows.erratum("(77), (78)", "phi_w^(2), damped oscillator", terms(printed_linear, 2, 2),
               terms(corrected_linear, 2, 2), engine_terms(*oscillator, 2, 2),
               "(77), (78): terms and weights are missing");
  rows.erratum("(77), (78)", "phi_w^(2)..(4), damped pendulum", terms(printed, 2, 4), terms(corrected, 2, 4),
               engine_terms(*pendulum, 2, 4), "(77), (78): terms and weights are missing");
  rows.reproduced("(78)", "corrected: phi_w^(2)..(5)", terms(corrected, 2, 5), engine_terms(*pendulum, 2, 5));
  rows.reproduced("(82)", "1/(k+1)! D_t^k: phi_w^(2)..(5)", terms(total, 2, 5),
                  engine_terms(*pendulum, 2, 5));
  // A superscript without brackets is a power.
  Numbers power = engine_terms(*pendulum, 1, 1);
  for (Quad& x : power) x *= x;
  rows.erratum("(82), (85)", "phi_w^2 for phi_w^(2)", power, terms(total, 2, 2),
               engine_terms(*pendulum, 2, 2), "(82), (85): superscripts are in brackets");
}

MeasuredOrder order(int m, const std::shared_ptr<const Model>& model) {
  const auto method = integrators()
                          .get("generating-function", "integrator")
                          .make({{"order", std::to_string(m)}, {"variant", "P"}});
  return measure_order(*method, model);
}

// Slopes settle to 0.02 before they are taken.
constexpr double slope_tolerance = 0.05;

void orders(Rows& rows) {
  const auto pendulum = damped("damped-pendulum");
  for (const int m : {1, 2, 3, 4})
    rows.measured("Theorem 4.3", "order for m = " + std::to_string(m), m, order(m, pendulum).slope,
                  slope_tolerance);
  const auto autonomous = systems().get("pendulum", "system").make({});
  for (const int m : {1, 3}) {
    const double slope = order(m, autonomous).slope;
    rows.claim("Theorem 4.3", "autonomous, m = " + std::to_string(m), std::to_string(m),
               to_string(Quad(slope), 4), std::abs(slope - m), std::abs(slope - (m + 1)) <= slope_tolerance,
               "Theorem 4.3: m + 1, odd m, autonomous");
  }
  const auto step =
      step_of("generating-function", {{"order", "3"}, {"variant", "P"}}, pendulum, {Quad(0.8), Quad(-0.4)});
  rows.reproduced("(88)", "K-symplectic at m = 3, damped pendulum", {Quad(0)},
                  {congruence_residual(step.jacobian, structure(*pendulum, t1, step.z).entries(),
                                       structure(*pendulum, t0, {Quad(0.8), Quad(-0.4)}).entries())});
}

}  // namespace

std::vector<ReproducedRow> expansion_rows() {
  Rows rows("4");
  coefficients(rows);
  orders(rows);
  return rows.take();
}

}  // namespace pfaff::su_qin
