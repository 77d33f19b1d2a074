#include <pfaff/integrators/runge_kutta/collocation_coefficients.hpp>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

namespace {

// Tableaux are known to some 1e-33; the control that changes a coefficient does so by 1e-6.
bool equal(const Quad& a, const Quad& b) { return abs(a - b) <= Quad(1e-29); }

template <class Number>
Number rounded(const Quad& x) {
  return Number(Real(x));
}
template <class Number>
std::vector<Number> rounded(const std::vector<Quad>& list) {
  std::vector<Number> result;
  for (const Quad& x : list) result.push_back(rounded<Number>(x));
  return result;
}
// matrix_ij for i < j becomes a multiple of the spacing at `offset`, equal to the number that mirrors it
// where the method is symmetric in time. The other triangle is matrix_ij + difference(i, j).
template <class Number, class Difference>
void round_triangle(const std::vector<Quad>& exact, bool symmetric, const Number& offset,
                    const Difference& difference, std::vector<Number>& matrix, std::size_t s) {
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = i + 1; j < s; ++j) {
      const bool mirrored = symmetric && i + j > s - 1;
      const Number upper =
          mirrored ? matrix[(s - 1 - j) * s + (s - 1 - i)] : on_grid(exact[i * s + j], offset);
      matrix[i * s + j] = upper;
    }
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < i; ++j) matrix[i * s + j] = difference(i, j, matrix[j * s + i]);
}

}  // namespace

template <class Number>
CollocationCoefficients<Number>::CollocationCoefficients(const GaussCoefficients& tableau)
    : stages(static_cast<std::size_t>(tableau.stages)) {
  const std::size_t s = stages;
  const std::vector<Quad>&a = tableau.matrix, &b = tableau.weights, &c = tableau.nodes;
  std::vector<Quad> d, exact_mu(s * s), exact_nu(s * s), exact_beta(s), start(s * s);
  for (const Quad& x : b) {
    d.push_back(x == Quad(0) ? Quad(1) : x);
    counted.push_back(Number(x == Quad(0) ? 0 : 1));
  }
  for (std::size_t i = 0; i < s; ++i)
    for (std::size_t j = 0; j < s; ++j) {
      exact_mu[i * s + j] = a[i * s + j] / d[j];
      for (std::size_t k = 0; k < s; ++k) exact_nu[i * s + j] += a[i * s + k] * a[k * s + j] / d[j];
      exact_beta[j] += b[i] * a[i * s + j] / d[j];
      start[i * s + j] = d[i] * lagrange(c, j, Quad(1) + c[i]) / d[j];
    }
  nodes = rounded<Number>(c);
  scale = rounded<Number>(d);
  mu = rounded<Number>(exact_mu);
  nu = rounded<Number>(exact_nu);
  beta = rounded<Number>(exact_beta);
  extrapolation = rounded<Number>(start);

  // What holds in exact arithmetic, and whether the numbers are of the size that the grids are made for.
  const Number half = Number(1) / Number(2), quarter = half / Number(2);
  bool symplectic = true, symmetric = true, second_order = true, small = true;
  for (std::size_t i = 0; i < s; ++i) {
    symmetric = symmetric && equal(c[i] + c[s - 1 - i], Quad(1));
    second_order = second_order && equal(c[i] + exact_beta[i], Quad(1)) && c[i] >= Quad(0) && c[i] <= Quad(1);
    for (std::size_t j = 0; j < s; ++j) {
      const Quad& mirror = exact_mu[(s - 1 - j) * s + (s - 1 - i)];
      symplectic = symplectic && equal(exact_mu[i * s + j] + exact_mu[j * s + i], Quad(1));
      symmetric = symmetric && equal(exact_mu[i * s + j], mirror);
      if (i < j)
        small = small && abs(rounded<Number>(exact_mu[i * s + j])) < half &&
                abs(rounded<Number>(exact_nu[i * s + j])) < quarter;
    }
  }
  if (!symplectic || !small) return;
  round_triangle(
      exact_mu, symmetric, Number(1) + half,
      [](std::size_t /*i*/, std::size_t /*j*/, const Number& other) { return Number(1) - other; }, mu, s);
  for (std::size_t i = 0; i < s; ++i) mu[i * s + i] = half;
  if (!second_order) return;
  for (std::size_t i = 0; i < s; ++i) {
    nodes[i] = symmetric && i > s - 1 - i ? Number(1) - nodes[s - 1 - i] : on_grid(c[i], half);
    beta[i] = Number(1) - nodes[i];
  }
  round_triangle(
      exact_nu, symmetric, half + quarter,
      [&](std::size_t i, std::size_t j, const Number& other) { return other + (nodes[i] - nodes[j]); }, nu,
      s);
}

template struct CollocationCoefficients<double>;
template struct CollocationCoefficients<Quad>;

}  // namespace pfaff
