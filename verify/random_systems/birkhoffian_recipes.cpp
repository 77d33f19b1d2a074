// Birkhoffian systems made of a Hamiltonian H(y, t) and a chart y = Y(z, t): the action of p dq - H dt in y,
// pulled back to z, plus the gauge dG, has
//
//   F_i = Y_p . d Y_q/d z_i + G_i,   B = H(Y, t) - Y_p . d Y_q/d t - G_t,   K = dF
//
// and Y is its Darboux chart. The chart does not keep the area in each plane (q_i, p_i), so that K depends on
// the state.
#include <algorithm>

#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

namespace {

using detail::moved;

// The polynomial of the old state and t0 in place of the new one and t, among the arguments of an alpha.
SparsePolynomial moved_to_old(const SparsePolynomial& p) {
  const std::size_t n = p.variables(), m = 2 * n + 1;
  SparsePolynomial old(m);
  for (const auto& [powers, c] : p.terms()) {
    Powers all(m + 1);
    std::copy(powers.begin(), powers.end(), all.begin() + static_cast<std::ptrdiff_t>(n));
    old.add(all, c);
  }
  return old;
}

// F and B from the chart, in the state's variables, and the energy in those of the chart.
void add_action(PolynomialSystem& system, const Polynomials& chart, const SparsePolynomial& energy,
                const SparsePolynomial& gauge) {
  const std::size_t n = system.dimension, d = n / 2;
  Polynomials form;
  for (std::size_t i = 0; i < n; ++i) {
    form.push_back(gauge.derivative(i));
    for (std::size_t a = 0; a < d; ++a) form[i] = form[i] + chart[d + a] * chart[a].derivative(i);
  }
  SparsePolynomial b = energy.at(chart) - gauge.derivative(n);
  for (std::size_t a = 0; a < d; ++a) b = b - chart[d + a] * chart[a].derivative(n);
  // su-qin (95) in the chart: w^ = (P' - P, Q' - Q), w = ((Q' + Q)/2, -(P' + P)/2). The arguments are the new
  // state at t, the old one at t0, and t0.
  const std::size_t m = 2 * n + 1;
  Polynomials alpha(2 * n, SparsePolynomial(m));
  for (std::size_t a = 0; a < n; ++a) {
    const SparsePolynomial later = moved(chart[a], m, 0), earlier = moved_to_old(chart[a]);
    const bool position = a < d;
    alpha[position ? d + a : a - d] = later - earlier;
    alpha[n + a] = Real::fraction(position ? 1 : -1, 2) * (later + earlier);
  }
  system.formulas[Formula::alpha] = alpha;
  system.formulas[Formula::one_form] = form;
  system.formulas[Formula::birkhoffian] = {b};
  system.formulas[Formula::chart] = chart;
}

}  // namespace

// Parts of both kinds: H in 2 d variables and the gauge in 2 d. Then s - 1 and f in q alone, where d = 1; or
// d shears f_i in q and d shears g_i in p.
PolynomialSystem detail::birkhoffian_system(const Recipe& recipe) {
  PolynomialSystem system;
  const std::size_t n = recipe.dimension, d = n / 2;
  system.dimension = n;
  const SparsePolynomial &energy = recipe.parts[0].front(), &gauge = recipe.parts[1].front();
  const auto x = [n](std::size_t k) { return SparsePolynomial::variable(n, k); };
  if (recipe.kind == SystemKind::scaled_form) {
    const SparsePolynomial scale = SparsePolynomial::constant(n, 1) + moved(recipe.parts[2].front(), n, 0);
    const SparsePolynomial shift = moved(recipe.parts[3].front(), n, 0);
    add_action(system, {x(0), scale * x(1) + shift}, energy, gauge);
    system.formulas[Formula::chart_inverse] = {x(0), x(1) - shift};
    system.chart_divisors = {SparsePolynomial::constant(n, 1), scale};
    return system;
  }
  Polynomials chart, inverse;
  for (std::size_t k = 0; k < n; ++k) chart.push_back(x(k));
  inverse = chart;
  for (std::size_t i = 0; i < d; ++i) chart[d + i] = x(d + i) + moved(recipe.parts[2][i], n, 0);
  const Polynomials momenta(chart.begin() + static_cast<std::ptrdiff_t>(d), chart.end());
  for (std::size_t i = 0; i < d; ++i) chart[i] = x(i) + recipe.parts[3][i].at(momenta);
  for (std::size_t i = 0; i < d; ++i) inverse[i] = x(i) - moved(recipe.parts[3][i], n, d);
  const Polynomials positions(inverse.begin(), inverse.begin() + static_cast<std::ptrdiff_t>(d));
  for (std::size_t i = 0; i < d; ++i) inverse[d + i] = x(d + i) - recipe.parts[2][i].at(positions);
  add_action(system, chart, energy, gauge);
  system.formulas[Formula::chart_inverse] = inverse;
  return system;
}

}  // namespace pfaff
