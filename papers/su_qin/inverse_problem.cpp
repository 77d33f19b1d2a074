// Su & Qin, section 2, (14)-(18): F and B back from K and D on a star-shaped region about 0. The printed
// integrals of a polynomial system are known in closed form, and the engine's Gauss quadrature is exact for
// them, so that printed and corrected rules are told apart to round-off.
#include <pfaff/brackets/birkhoffian/inverse_problem.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/papers/su_qin/rows.hpp>
#include <pfaff/papers/su_qin/sample.hpp>

namespace pfaff::su_qin {

namespace {

constexpr int nodes = 6;  // exact to degree 11 in lambda; the integrands reach 4

Numbers values_at(const std::vector<printed::Polynomial>& functions, const Numbers& zt) {
  Numbers values;
  for (const printed::Polynomial& f : functions) values.push_back(f.at(zt));
  return values;
}

}  // namespace

void inverse_problem(Rows& rows) {
  const auto model = polynomial_system();
  const printed::BirkhoffSystem printed = printed_system();
  const Numbers zt = joined(sample_state, {t0});
  const auto k = model->tape(Formula::structure), d = model->tape(Formula::covector);
  const ActionForm action = pfaff::inverse_problem(*k, *d, std::vector<Real>(4), nodes);
  const Tape &form = action.one_form, &b = action.birkhoffian;
  const auto as_printed = printed::constructed_form(printed, Rational(1) / Rational(2), 0),
             corrected = printed::constructed_form(printed, Rational(1), 1);
  rows.erratum("(17)", "F from K", values_at(as_printed, zt), values_at(corrected, zt),
               value(form, t0, sample_state), "(17): the weight is lambda, not 1/2");
  // What F is for: its curl is K.
  const Matrix<Quad> slope(4, value(jacobian_tape(form), t0, sample_state));
  rows.reproduced("(17)", "corrected: curl of F", printed::listed(printed::structure_at(printed, zt)),
                  (slope.transposed() - slope).entries());
  const Quad function = printed::constructed_function(printed, corrected).at(zt);
  rows.erratum("(18)", "B from D and F", {function}, {-function}, value(b, t0, sample_state),
               "(18): B has a minus in front");
  const std::vector<printed::Polynomial> forces = printed::forces(printed, corrected);
  const Matrix<Quad> fall(1, value(jacobian_tape(b), t0, sample_state));
  rows.reproduced("(14)", "-grad B with B from (17), (18)", values_at(forces, zt), (-fall).entries());
  // (15): the slopes of D + F_t, transposed on our side.
  const Tape sum = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto first = evaluate(*d, t, z), rate = time_derivative(form, t, z);
    for (std::size_t i = 0; i < 4; ++i) out[i] = first[i] + rate[i];
  });
  std::vector<printed::Polynomial> slopes;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) slopes.push_back(forces[i].slope(j));
  rows.reproduced("(15)", "symmetry of the slopes of D + F_t", values_at(slopes, zt),
                  Matrix<Quad>(4, value(jacobian_tape(sum), t0, sample_state)).transposed().entries());
}

}  // namespace pfaff::su_qin
