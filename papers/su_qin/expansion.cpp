// Su & Qin, section 4, (77)-(91): the coefficients of the generating function (Theorem 4.2), printed in
// closed form and ours from the engine that the schemes use, and the order of the schemes (Theorem 4.3),
// measured.
#include <pfaff/papers/printed/generating.hpp>
#include <pfaff/papers/printed/oscillator.hpp>
#include <pfaff/papers/su_qin/rows.hpp>
#include <pfaff/verify/check.hpp>

namespace pfaff::su_qin {

namespace {

const Numbers at{Quad(0.6), Quad(-0.3)};

using printed::Expansion;

Numbers terms(const std::vector<printed::Gradient>& phi, int first, int last) {
  Numbers all;
  for (int k = first; k <= last; ++k)
    for (const auto& component : phi[static_cast<std::size_t>(k)]) all.push_back(component.at(at));
  return all;
}
Numbers engine_terms(const Model& model, int first, int last) {
  Numbers all;
  for (int k = first; k <= last; ++k) all = joined(all, engine_term(model, k, at));
  return all;
}

void coefficients(Rows& rows) {
  const auto oscillator = damped("damped-oscillator"), pendulum = damped("damped-pendulum");
  const printed::GeneratingGradient linear(nu, t0, false), nonlinear(nu, t0, true);
  const auto corrected_linear = linear.terms(2, Expansion::corrected);
  const auto corrected = nonlinear.terms(5, Expansion::corrected);
  const auto total = nonlinear.terms(5, Expansion::total_derivative);

  rows.reproduced("(80), (81)", "phi_w^(0), phi_w^(1), damped pendulum",
                  joined(Numbers(2), terms(corrected, 1, 1)), engine_terms(*pendulum, 0, 1));
  // (77) and (78) differ in their third terms. Up to phi_w^(3) the lengths of the lists of indices, which
  // their last lines print in different orders, are all one.
  for (const auto& [rule, equation] : {std::pair{Expansion::as_77, "(77)"}, {Expansion::as_78, "(78)"}}) {
    const std::string entry = std::string(equation) + ": terms and weights are missing";
    rows.erratum(equation, "phi_w^(2), damped oscillator", terms(linear.terms(2, rule), 2, 2),
                 terms(corrected_linear, 2, 2), engine_terms(*oscillator, 2, 2), entry);
    rows.erratum(equation, "phi_w^(2), phi_w^(3), damped pendulum", terms(nonlinear.terms(3, rule), 2, 3),
                 terms(corrected, 2, 3), engine_terms(*pendulum, 2, 3), entry);
  }
  rows.reproduced("(77), (78)", "corrected: phi_w^(2)..(5)", terms(corrected, 2, 5),
                  engine_terms(*pendulum, 2, 5));
  rows.reproduced("(82), Theorem 4.2", "1/(k+1)! D_t^k: phi_w^(2)..(5)", terms(total, 2, 5),
                  engine_terms(*pendulum, 2, 5));
  rows.qualitative("(82), (85)", "superscripts without brackets", {"phi_w^{k+1}", "phi_w^(k+1)"},
                   {at_most(distance(terms(total, 2, 2), engine_terms(*pendulum, 2, 2)), at_round_off)},
                   "(82), (85): they are coefficients, not powers");
  // (79), (83): the series and its derivative in w, against the gradient that the schemes use. At tau = 1 its
  // terms are the coefficients.
  const printed::Oscillator formula(nu, t0, t0 + Quad(1));
  const Numbers series = formula.gradient(2, {at[0], at[1]});
  Numbers ours(2);
  for (int k = 1; k <= 2; ++k) {
    const Numbers term = engine_term(*oscillator, k, {at[0], -at[1]});
    ours[0] += term[0];
    ours[1] -= term[1];
  }
  rows.reproduced("(79), (87)", "sum of the terms to tau^2, damped oscillator", series, ours);
}

MeasuredOrder order(int m, const std::shared_ptr<const Model>& model) {
  const auto method = integrators()
                          .get("generating-function", "integrator")
                          .make({{"order", std::to_string(m)}, {"variant", "P"}, {"extra", "0"}});
  return measure_order(*method, model);
}

// The slopes have settled to within 0.02 at the steps where they are taken.
constexpr double slope_tolerance = 0.05;

void orders(Rows& rows) {
  const auto pendulum = damped("damped-pendulum");
  for (const int m : {1, 2, 3, 4})
    rows.order("Theorem 4.3", "order for m = " + std::to_string(m), m, order(m, pendulum).slope,
               slope_tolerance);
  const auto autonomous = systems().get("pendulum", "system").make({});
  for (const int m : {1, 3})
    rows.order("Theorem 4.3", "autonomous, m = " + std::to_string(m), m, order(m, autonomous).slope,
               slope_tolerance);
  const Numbers z{Quad(0.8), Quad(-0.4)};
  const printed::Oscillator formula(nu, t0, t1);  // whose K is the pendulum's
  for (const int m : {1, 2, 3}) {
    const auto step = step_of("generating-function",
                              {{"order", std::to_string(m)}, {"variant", "P"}, {"extra", "0"}}, pendulum, z);
    const Matrix<Quad> jacobian(2, step.jacobian);
    rows.reproduced("(88)", "K-symplectic at m = " + std::to_string(m) + ", damped pendulum",
                    printed::listed(formula.k0()),
                    (jacobian.transposed() * structure(*pendulum, t1, step.z) * jacobian).entries());
  }
  const auto oscillator = damped("damped-oscillator");
  const Numbers start{Quad(0.5), Quad(0.1)};
  for (const int m : {1, 2})
    rows.reproduced(
        "(88)", "the scheme at m = " + std::to_string(m) + ", damped oscillator", formula.step(m, start),
        step_of("generating-function", {{"order", std::to_string(m)}, {"variant", "P"}, {"extra", "0"}},
                oscillator, start)
            .z);
}

}  // namespace

void expansion_rows(Rows& rows) {
  coefficients(rows);
  orders(rows);
}

}  // namespace pfaff::su_qin
