// Su & Qin, section 2, (14)-(18): F and B back from K and D on a star-shaped region about 0. For a polynomial
// system Gauss quadrature with enough nodes makes the integrals exact, so that printed and corrected rules
// are told apart to round-off.
#include <pfaff/bench/reproduce/su_qin/rows.hpp>
#include <pfaff/bench/reproduce/su_qin/sample.hpp>
#include <pfaff/brackets/birkhoffian/inverse_problem.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/integrators/gauss_coefficients.hpp>

namespace pfaff::su_qin {

namespace {

constexpr int nodes = 6;  // exact to degree 11 in lambda; the integrands reach 4

// int_0^1 integrand(lambda z) dlambda.
template <class Integrand>
std::vector<Recorded> integrated(std::size_t outputs, Arguments z, Integrand&& integrand) {
  static const GaussCoefficients gauss = gauss_coefficients(nodes);
  std::vector<Recorded> sum(outputs);
  for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
    const Recorded lambda(Real(gauss.nodes[i])), weight(Real(gauss.weights[i]));
    std::vector<Recorded> along(z.begin(), z.end());
    for (Recorded& x : along) x = lambda * x;
    const std::vector<Recorded> f = integrand(along);
    for (std::size_t k = 0; k < outputs; ++k) sum[k] = sum[k] + weight * f[k];
  }
  return sum;
}

// (17) as printed: F_i = 1/2 int z_j K_ji(lambda z) dlambda.
Tape printed_one_form(const Tape& k) {
  return record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto f = integrated(4, z, [&](const std::vector<Recorded>& along) {
      const auto at = evaluate(k, t, along);
      std::vector<Recorded> row(4);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) row[i] = row[i] + z[j] * at[j * 4 + i] / 2;
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

// (18) as printed: B = int z_i (D_i + F_i,t)(lambda z) dlambda, without the minus.
Tape printed_birkhoffian(const Tape& d, const Tape& form) {
  return record(4, 1, [&](const Recorded& t, Arguments z, Results out) {
    out[0] = integrated(1, z, [&](const std::vector<Recorded>& along) {
      const auto sum = sum_with_rate(d, form, t, along);
      Recorded product(0);
      for (std::size_t k = 0; k < 4; ++k) product = product + z[k] * sum[k];
      return std::vector<Recorded>{product};
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
  // The quadrature of D would not be exact for the quotient that recording -K K^-1 g leaves: take -g itself.
  const auto polynomial_d = model->tape(Formula::covector);
  const ActionForm action = pfaff::inverse_problem(*k, *polynomial_d, std::vector<Real>(4), nodes);
  const Tape &form = action.one_form, &b = action.birkhoffian;
  rows.erratum("(17)", "curl of F is K", curl(printed_one_form(*k)), curl(form), value(*k, t0, sample_state),
               "(17): the weight is lambda, not 1/2");
  const Tape expected = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto sum = sum_with_rate(d, form, t, z);
    std::copy(sum.begin(), sum.end(), out.begin());
  });
  rows.erratum("(18)", "-grad B = D + F_t", minus_gradient(printed_birkhoffian(*polynomial_d, form)),
               minus_gradient(b), value(expected, t0, sample_state), "(18): B has a minus in front");
  rows.reproduced("(14)", "-grad B with B from (17), (18)", value(expected, t0, sample_state),
                  minus_gradient(b));
  const Matrix<Quad> slope(4, value(jacobian_tape(expected), t0, sample_state));
  rows.reproduced("(15)", "symmetry of the slopes of D + F_t", slope.entries(), slope.transposed().entries());
  return rows.take();
}

}  // namespace pfaff::su_qin
