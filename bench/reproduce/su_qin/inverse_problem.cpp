// Su & Qin, section 2, (14)-(18): F and B back from K and D on a star-shaped region about 0. For a polynomial
// system Gauss quadrature with enough nodes makes the integrals exact, so that printed and corrected rules
// are told apart to round-off.
#include <pfaff/bench/reproduce/su_qin/rows.hpp>
#include <pfaff/bench/reproduce/su_qin/sample.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/integrators/gauss_coefficients.hpp>

namespace pfaff::su_qin {

namespace {

constexpr int nodes = 6;  // exact to degree 11 in lambda; the integrands reach 4

// int_0^1 integrand(lambda, lambda z) dlambda.
template <class Integrand>
std::vector<Recorded> integrated(std::size_t outputs, Arguments z, Integrand&& integrand) {
  static const GaussCoefficients gauss = gauss_coefficients(nodes);
  std::vector<Recorded> sum(outputs);
  for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
    const Recorded lambda(Real(gauss.nodes[i])), weight(Real(gauss.weights[i]));
    std::vector<Recorded> along(z.begin(), z.end());
    for (Recorded& x : along) x = lambda * x;
    const std::vector<Recorded> f = integrand(lambda, along);
    for (std::size_t k = 0; k < outputs; ++k) sum[k] = sum[k] + weight * f[k];
  }
  return sum;
}

// (17): F_i = int weight(lambda) z_j K_ji(lambda z) dlambda; lambda, or 1/2 as printed.
Tape one_form(const Tape& k, bool printed) {
  return record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto f = integrated(4, z, [&](const Recorded& lambda, const std::vector<Recorded>& along) {
      const auto at = evaluate(k, t, along);
      std::vector<Recorded> row(4);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          row[i] = row[i] + (printed ? Recorded(1) / Recorded(2) : lambda) * z[j] * at[j * 4 + i];
      return row;
    });
    std::copy(f.begin(), f.end(), out.begin());
  });
}

std::vector<Recorded> sum_with_rate(const Tape& d, const Tape& form, const Recorded& t, Arguments z) {
  auto sum = evaluate(d, t, z);
  const auto rate = time_derivative(form, t, z);
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = sum[k] + rate[k];
  return sum;
}

// (18): B = -int z_i (D_i + F_i,t)(lambda z) dlambda; printed without the minus.
Tape birkhoffian(const Tape& d, const Tape& form, bool printed) {
  return record(4, 1, [&](const Recorded& t, Arguments z, Results out) {
    out[0] = integrated(1, z, [&](const Recorded&, const std::vector<Recorded>& along) {
      const auto sum = sum_with_rate(d, form, t, along);
      Recorded product(0);
      for (std::size_t k = 0; k < 4; ++k) product = product + z[k] * sum[k];
      return std::vector<Recorded>{printed ? product : -product};
    })[0];
  });
}

Numbers curl(const Tape& form) {
  const Matrix<Quad> slope(4, value(jacobian_tape(form), t0, sample_state));
  return (slope.transposed() - slope).entries();
}
Numbers minus_gradient(const Tape& function) {
  return (-Matrix<Quad>(1, value(jacobian_tape(function), t0, sample_state))).entries();
}

}  // namespace

std::vector<ReproducedRow> inverse_problem() {
  Rows rows("2");
  const auto model = polynomial_system();
  const auto k = model->tape(Formula::structure);
  // D = -K z' from the field alone: what is given is (K, D), not the F and B behind it.
  const auto field = model->tape(Formula::field);
  const Tape d = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto at = evaluate(*k, t, z), rate = evaluate(*field, t, z);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) out[i] = out[i] - at[i * 4 + j] * rate[j];
  });
  // The quadrature of D would not be exact for the quotient that recording -K K^-1 g leaves: take g itself.
  const Tape polynomial_d = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto slope = gradient(*model->tape(Formula::birkhoffian), t, z, std::vector<Recorded>{Recorded(1)});
    const auto rate = time_derivative(*model->tape(Formula::one_form), t, z);
    for (std::size_t i = 0; i < 4; ++i) out[i] = -(slope[i] + rate[i]);
  });
  const Tape printed_form = one_form(*k, true), form = one_form(*k, false);
  rows.erratum("(17)", "curl of F is K", curl(printed_form), curl(form), value(*k, t0, sample_state),
               "(17): the weight is lambda, not 1/2");
  const Tape printed_b = birkhoffian(polynomial_d, form, true), b = birkhoffian(polynomial_d, form, false);
  const Tape expected = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto sum = sum_with_rate(d, form, t, z);
    std::copy(sum.begin(), sum.end(), out.begin());
  });
  rows.erratum("(18)", "-grad B = D + F_t", minus_gradient(printed_b), minus_gradient(b),
               value(expected, t0, sample_state), "(18): B has a minus in front");
  rows.reproduced("(14)", "-grad B with B from (17), (18)", value(expected, t0, sample_state),
                  minus_gradient(b));
  const Matrix<Quad> slope(4, value(jacobian_tape(expected), t0, sample_state));
  rows.reproduced("(15)", "symmetry of the slopes of D + F_t", slope.entries(), slope.transposed().entries());
  return rows.take();
}

}  // namespace pfaff::su_qin
