// Su & Qin, section 2, (1)-(13) and (19)-(21): Birkhoff's equations, self-adjointness, the 2-forms, the flow.
#include <pfaff/brackets/birkhoffian/birkhoffian_form.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/papers/printed/oscillator.hpp>
#include <pfaff/papers/su_qin/rows.hpp>
#include <pfaff/papers/su_qin/sample.hpp>

namespace pfaff::su_qin {

namespace {

// q' = p, p' = t - q^2 with an F that is free of time: a semi-autonomous system.
struct SemiAutonomous {
  static constexpr int dimension = 2;
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return z[1] * z[1] / 2 - t * z[0] + z[0] * z[0] * z[0] / 3;
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    form[0] = z[1] / 2;
    form[1] = -(z[0] / 2);
  }
};

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
// K z' of the engine, with its own field.
Numbers structure_times_field(const Model& model, const Quad& t, const Numbers& z) {
  return structure(model, t, z) * value(*model.tape(Formula::field), t, z);
}

void equations(Rows& rows) {
  const auto model = polynomial_system();
  const printed::BirkhoffSystem printed = printed_system();
  const Numbers v{Quad(0.2), Quad(0.5), Quad(-0.3), Quad(0.8)}, zt = joined(sample_state, {t0});
  rows.erratum("(1), (7), (16)", "index of K", printed::equations_at(printed, zt, v, true),
               printed::equations_at(printed, zt, v, false),
               value(euler_lagrange(*model), t0, joined(sample_state, v)),
               "(1), (7), (16): K_ij z_j', as in (4)");
  // Each class of Definition 2.1 with a system of its own.
  const auto autonomous = systems().get("lotka-volterra", "system").make({}),
             semi = make_model(
                 {.name = "semi-autonomous", .title = "", .reference = "su-qin (3)", .initial = {1, 0}},
                 SemiAutonomous{}),
             pendulum = damped("damped-pendulum");
  const Numbers z{Quad(0.8), Quad(1.3)};
  rows.reproduced("(2)", "K z' = grad B, predator and prey", {1 - 2 / z[0], 1 - 1 / z[1]},
                  structure_times_field(*autonomous, t0, z));
  rows.reproduced("(3)", "K z' = grad B(z, t), a driven particle", {z[0] * z[0] - t0, z[1]},
                  structure_times_field(*semi, t0, z));
  const Quad e0 = exp(nu * t0);
  rows.reproduced("(4)", "K z' = grad B + F_t, damped pendulum", {e0 * (nu * z[1] + sin(z[0])), e0 * z[1]},
                  structure_times_field(*pendulum, t0, z));
  rows.qualitative("Definition 2.1", "three classes",
                   {"autonomous, semi-autonomous, nonautonomous", "told apart"},
                   {is_true(birkhoffian_class(*autonomous) == BirkhoffianClass::autonomous),
                    is_true(birkhoffian_class(*semi) == BirkhoffianClass::semi_autonomous),
                    is_true(birkhoffian_class(*pendulum) == BirkhoffianClass::nonautonomous)},
                   "the three systems above are called so");
  const auto k = printed::structure_at(printed, zt);
  rows.reproduced("(5)", "K from F", printed::listed(k), structure(*model, t0, sample_state).entries());
  rows.reproduced("(6)", "det K", {printed::determinant(k)},
                  {determinant(structure(*model, t0, sample_state))});
}

// (8): the largest residual of each condition.
Numbers largest_residuals(const std::shared_ptr<const Tape>& k, const Tape& d) {
  const auto r = self_adjointness<Quad>(k, d, t0, sample_state);
  return {r.skew.residual, r.closed.residual, r.time.residual};
}

void conditions(Rows& rows) {
  const auto model = polynomial_system();
  const printed::BirkhoffSystem printed = printed_system();
  const Numbers zt = joined(sample_state, {t0});
  const auto k = model->tape(Formula::structure);
  const Tape d = *model->tape(Formula::covector);
  std::vector<printed::Polynomial> force;
  for (std::size_t i = 0; i < 4; ++i) force.push_back(printed.d(i));
  rows.reproduced("(8), Proposition 2.1", "a Birkhoffian system is self-adjoint",
                  printed::self_adjointness_at(printed, force, zt), largest_residuals(k, d));
  // A force that is not of this form: -z_0 z_1 added to D_0 breaks the third condition and that one alone.
  const Tape forced = record(4, 4, [&](const Recorded& t, Arguments z, Results out) {
    const auto value = evaluate(d, t, z);
    std::copy(value.begin(), value.end(), out.begin());
    out[0] = out[0] - z[0] * z[1];
  });
  force[0] = force[0] - printed::Polynomial::variable(0) * printed::Polynomial::variable(1);
  const Numbers broken = printed::self_adjointness_at(printed, force, zt);
  rows.reproduced("(8)", "a force -z_0 z_1 breaks the third condition", broken, largest_residuals(k, forced));
}

void forms(Rows& rows) {
  const auto model = polynomial_system();
  const printed::BirkhoffSystem printed = printed_system();
  const Numbers u{Quad(1), Quad(0.5), Quad(-0.2), Quad(0.7), Quad(0.4)};
  const Numbers v{Quad(-0.3), Quad(0.8), Quad(0.6), Quad(0.1), Quad(0.9)}, zt = joined(sample_state, {t0});
  const Matrix<Quad> k = structure(*model, t0, sample_state);
  const Numbers d = value(*model->tape(Formula::covector), t0, sample_state);
  Matrix<Quad> contact(5, 5);
  for (std::size_t i = 0; i < 4; ++i) {
    contact(0, i + 1) = -d[i];
    contact(i + 1, 0) = d[i];
    for (std::size_t j = 0; j < 4; ++j) contact(i + 1, j + 1) = k(i, j);
  }
  rows.reproduced("(12)", "K^ = d(-B dt + F.dz)", printed::listed(printed::contact_structure_at(printed, zt)),
                  contact.entries());
  const Numbers state_u(u.begin() + 1, u.end()), state_v(v.begin() + 1, v.end());
  Quad two_form(0);  // the engine's 2-form d(F.dz), K(u, v)
  const Numbers image = k * state_v;
  for (std::size_t i = 0; i < 4; ++i) two_form += state_u[i] * image[i];
  const Quad sum = printed::double_sum(printed::structure_at(printed, zt), state_u, state_v);
  rows.erratum("(9), (10)", "the double sum is d(F.dz)", {sum}, {sum / 2}, {two_form},
               "(9), (10): the double sum is twice d(F.dz)");
  Quad contact_form(0);
  const Numbers contact_image = contact * v;
  for (std::size_t i = 0; i < 5; ++i) contact_form += u[i] * contact_image[i];
  const Quad whole = printed::double_sum(printed::contact_structure_at(printed, zt), u, v);
  rows.erratum("(11), (13)", "the double sum is d(F~.dz~)", {whole}, {whole / 2}, {contact_form},
               "(11), (13): the double sum is twice d(F~.dz~)");
  rows.reproduced("(13)", "d(F~.dz~)", {printed::exterior_derivative_at(printed, zt, u, v)}, {contact_form});
  const Numbers kernel = joined({Quad(1)}, value(*model->tape(Formula::field), t0, sample_state));
  rows.reproduced("(11)", "K^ (1, z') = 0", Numbers(5), contact * kernel);
}

void flow(Rows& rows) {
  const auto oscillator = damped("damped-oscillator");
  const printed::Oscillator printed(nu, t0, t1);
  const Numbers anywhere(2);
  const Matrix<Quad> k = structure(*oscillator, t0, anywhere),
                     slope(2, value(*oscillator->tape(Formula::field_jacobian), t0, anywhere));
  // (19): K along the flow has the rate K_t + A^T K + K A = 0, with K_t = nu K.
  Numbers opposite = printed::listed(printed.k0());
  for (Quad& x : opposite) x *= -nu;
  rows.reproduced("(19)", "-K_t of the flow", opposite, (slope.transposed() * k + k * slope).entries());
  const Matrix<Quad> m = linear_flow<Quad>(*oscillator, tau);
  const Matrix<Quad> pulled = m.transposed() * structure(*oscillator, t1, anywhere) * m;
  rows.reproduced("(21), (28), (31)", "M^T K(z', t') M of the exact flow", printed::listed(printed.k0()),
                  pulled.entries());
  const Numbers u{Quad(0.5), Quad(-0.2)}, v{Quad(0.3), Quad(0.8)},
      hat_u = m * u, image = structure(*oscillator, t1, anywhere) * (m * v);
  rows.reproduced("(20)", "2-form on two vectors and on their images",
                  {printed::double_sum(printed.k0(), u, v) / 2}, {hat_u[0] * image[0] + hat_u[1] * image[1]});
}

}  // namespace

void birkhoffian_systems(Rows& rows) {
  equations(rows);
  conditions(rows);
  forms(rows);
  flow(rows);
}

}  // namespace pfaff::su_qin
