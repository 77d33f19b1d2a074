// Su & Qin, section 2, (1)-(13) and (21): Birkhoff's equations, self-adjointness, the 2-forms.
#include <pfaff/bench/reproduce/su_qin/rows.hpp>
#include <pfaff/bench/reproduce/su_qin/sample.hpp>
#include <pfaff/brackets/birkhoffian/self_adjointness.hpp>
#include <pfaff/core/tape/derivatives.hpp>

namespace pfaff::su_qin {

namespace {

// The Euler-Lagrange expression of F.v - B, d_i (F.v - B) - d/dt F_i, at z with any velocity v: inputs (z,
// v).
Tape euler_lagrange(const Model& model) {
  const int n = model.dimension();
  const auto size = static_cast<std::size_t>(n);
  const auto form = model.tape(Formula::one_form);
  const Tape lagrangian = record(2 * n, 1, [&](const Recorded& t, Arguments x, Results out) {
    const auto f = evaluate(*form, t, x.first(size));
    out[0] = -evaluate(*model.tape(Formula::birkhoffian), t, x.first(size))[0];
    for (std::size_t k = 0; k < size; ++k) out[0] = out[0] + f[k] * x[size + k];
  });
  return record(2 * n, n, [&](const Recorded& t, Arguments x, Results out) {
    const auto slope = gradient(lagrangian, t, x, std::vector<Recorded>{Recorded(1)});
    const auto rate = directional_derivative(*form, t, Recorded(1), x.first(size), x.subspan(size));
    for (std::size_t k = 0; k < size; ++k) out[k] = slope[k] - rate[k];
  });
}

void equations(Rows& rows) {
  const auto model = polynomial_system();
  const Numbers v{Quad(0.2), Quad(0.5), Quad(-0.3), Quad(0.8)};
  const Matrix<Quad> k = structure(*model, t0, sample_state);
  const Numbers d = value(*model->tape(Formula::covector), t0, sample_state);
  Numbers second = k * v, first = k.transposed() * v;
  for (std::size_t i = 0; i < v.size(); ++i) {
    second[i] += d[i];
    first[i] += d[i];
  }
  rows.erratum("(1), (7), (16)", "index of K", first, second,
               value(euler_lagrange(*model), t0, joined(sample_state, v)),
               "(1), (7), (16): K_ij z_j', as in (4)");
  // (4) with the damped pendulum's field as its author writes it, p and -nu p - sin r.
  const auto pendulum = damped("damped-pendulum");
  const Numbers z{Quad(0.8), Quad(-0.4)};
  const Numbers field = value(*pendulum->tape(Formula::field), t0, z);
  Numbers residual = structure(*pendulum, t0, z) * field;
  const Numbers pendulum_d = value(*pendulum->tape(Formula::covector), t0, z);
  for (std::size_t i = 0; i < 2; ++i) residual[i] += pendulum_d[i];
  rows.reproduced("(4)", "K z' - grad B - F_t of the damped pendulum", Numbers(2), residual);
}

// (8): the largest residual of each condition.
Numbers largest_residuals(const std::shared_ptr<const Tape>& k, const Tape& d) {
  const auto r = self_adjointness<Quad>(k, d, t0, sample_state);
  return {r.skew.residual, r.closed.residual, r.time.residual};
}

void conditions(Rows& rows) {
  const auto model = polynomial_system();
  const auto k = model->tape(Formula::structure);
  const Tape d = *model->tape(Formula::covector);
  rows.reproduced("(8)", "conditions of self-adjointness", Numbers(3), largest_residuals(k, d));
  // A force that is not of this form: -z_0 z_1 added to D_0 breaks the third condition and that one alone.
  const Tape forced = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto value = evaluate(d, t, z);
    std::copy(value.begin(), value.end(), out.begin());
    out[0] = out[0] - z[0] * z[1];
  });
  const Numbers broken = largest_residuals(k, forced);
  rows.qualitative("(8)", "names what fails", "not self-adjoint", shown(broken),
                   static_cast<double>(broken[2]), clearly,
                   broken[0] == Quad(0) && static_cast<double>(broken[1]) <= at_round_off &&
                       static_cast<double>(broken[2]) > clearly,
                   "a force -z_0 z_1 breaks the third condition alone");
}

// The double sums (9), (11) of a matrix against the exterior derivative of its form, both on two vectors.
void forms(Rows& rows) {
  const auto model = polynomial_system();
  const Numbers u{Quad(1), Quad(0.5), Quad(-0.2), Quad(0.7), Quad(0.4)};
  const Numbers v{Quad(-0.3), Quad(0.8), Quad(0.6), Quad(0.1), Quad(0.9)};
  // F~ = (-B, F) on (t, z).
  const Tape form = record(5, 5, [&](const Recorded&, Arguments x, Results out) {
    out[0] = -evaluate(*model->tape(Formula::birkhoffian), x[0], x.subspan(1))[0];
    const auto f = evaluate(*model->tape(Formula::one_form), x[0], x.subspan(1));
    std::copy(f.begin(), f.end(), out.begin() + 1);
  });
  const Numbers x = joined({t0}, sample_state);
  const Matrix<Quad> slope(5, value(jacobian_tape(form), Quad(0), x)),
      k = structure(*model, t0, sample_state);
  const Numbers d = value(*model->tape(Formula::covector), t0, sample_state);
  Matrix<Quad> contact(5, 5);
  for (std::size_t i = 0; i < 4; ++i) {
    contact(0, i + 1) = -d[i];
    contact(i + 1, 0) = d[i];
    for (std::size_t j = 0; j < 4; ++j) contact(i + 1, j + 1) = k(i, j);
  }
  rows.reproduced("(12)", "K^ = d(-B dt + F.dz)", contact.entries(), (slope.transposed() - slope).entries());
  Quad sum(0), exterior(0);
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = 0; j < 5; ++j) {
      sum += contact(i, j) * (u[i] * v[j] - u[j] * v[i]);
      exterior += slope(j, i) * (u[i] * v[j] - v[i] * u[j]);
    }
  rows.erratum("(10), (11), (13)", "the double sum", {exterior}, {Quad(2) * exterior}, {sum},
               "(10), (11), (13): it is twice d(F.dz)");
  Numbers kernel = joined({Quad(1)}, value(*model->tape(Formula::field), t0, sample_state));
  rows.reproduced("(11)", "K^ (1, z') = 0", Numbers(5), contact * kernel);
}

void flow(Rows& rows) {
  const auto oscillator = damped("damped-oscillator");
  const Numbers anywhere(2);
  const Matrix<Quad> m = linear_flow<Quad>(*oscillator, tau);
  const Matrix<Quad> pulled = m.transposed() * structure(*oscillator, t1, anywhere) * m;
  rows.reproduced("(21)", "M^T K(z', t') M of the exact flow", structure(*oscillator, t0, anywhere).entries(),
                  pulled.entries());
}

}  // namespace

std::vector<ReproducedRow> birkhoffian_systems() {
  Rows rows("2");
  equations(rows);
  conditions(rows);
  forms(rows);
  flow(rows);
  return rows.take();
}

}  // namespace pfaff::su_qin
