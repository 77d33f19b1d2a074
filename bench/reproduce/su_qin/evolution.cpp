// Su & Qin, section 4, (56)-(76): the flow's law, the evolution of the generating function (Theorem 4.1) on
// the exact flow of the damped oscillator, the Hamilton-Jacobi equations.
#include <pfaff/bench/reproduce/su_qin/rows.hpp>
#include <pfaff/core/tape/derivatives.hpp>
#include <pfaff/integrators/generating_expansion.hpp>
#include <pfaff/integrators/lagrangian_transformation.hpp>

namespace pfaff::su_qin {

namespace {

// q' = p, p' = t - q^2 (or t alone): time enters B and nothing else.
struct Driven {
  static constexpr int dimension = 2;
  int stiffness = 0;
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& t, In<T> q) const {
    return -(t * q[0]) + stiffness * q[0] * q[0] * q[0] / 3;
  }
};
std::shared_ptr<const Model> driven(int stiffness) {
  return make_model({.name = "driven", .title = "", .reference = "su-qin (3)", .initial = {1, 0}},
                    Driven{stiffness});
}

// (56): three Gauss stages solve q'' = t exactly.
void flow_law(Rows& rows) {
  const auto model = driven(0);
  const auto method = integrators().get("gauss", "integrator").make({{"stages", "3"}});
  StepDifferentiator<Quad> differentiate(*method, model);
  const auto g = [&](const Quad& to, const Quad& from, const Numbers& z) {
    return differentiate(from, to - from, z).z;
  };
  const Numbers z{Quad(0.3), Quad(-0.2)};
  const Quad zero(0), a(0.5), b(0.75);
  rows.erratum("(56)", "g^{t1+t2} = g^{t1} g^{t2}", g(b, zero, g(a, zero, z)), g(a + b, a, g(a, zero, z)),
               g(a + b, zero, z), "(56): g(t2,t1) g(t1,t0) = g(t2,t0)");
}

// Theorem 4.1: phi_w = N(t) w with N = sigma(M(t)) for the oscillator's exact M. Its derivative in t at fixed
// w comes from dual numbers and knows nothing of (61).
void theorem(Rows& rows) {
  using D = Dual<Quad, 1>;
  const auto model = damped("damped-oscillator");
  const AlphaTapes tapes = chart_alpha(*model);
  LagrangianTransformation<D> alpha(shared(tapes.forward));
  const std::vector<D> anywhere(2);
  const Matrix<D> m = linear_flow<D>(*model, D::variable(tau, 0));
  const FractionalTransformation<D> blocks = alpha.blocks(D::variable(t1, 0), D(t0), anywhere, anywhere);
  const Matrix<D> n = blocks(m);
  Matrix<Quad> n0(2, 2), slope(2, 2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      n0(i, j) = n(i, j).value;
      slope(i, j) = n(i, j).derivative[0];
    }
  const Numbers w{Quad(0.6), Quad(-0.3)}, w_hat = n0 * w, exact = slope * w;
  const Numbers ours =
      value(evolution(*model, tapes), t1, joined(joined(w_hat, w), joined(n0.entries(), {t0})));

  // The same by hand, in the pieces of (61) and (69).
  const Numbers states = value(tapes.backward, t1, joined(joined(w_hat, w), {t0}));
  const Numbers new_z = part(states, 0, 2), old_z = part(states, 2, 2);
  LagrangianTransformation<Quad> in_quad(shared(tapes.forward));
  const Numbers partial = in_quad.time_derivative(t1, t0, new_z, old_z);
  const auto at = in_quad.blocks(t1, t0, new_z, old_z);
  const Numbers rate = value(*model->derived(Formula::field), t1, new_z);  // K^-1 (grad B + F_t)
  const auto pieces = [&](int sign, bool matrix) {
    Numbers w_hat_rate = at.a * rate, w_rate = at.c * rate;
    for (std::size_t i = 0; i < 2; ++i) {
      w_hat_rate[i] = Quad(sign) * w_hat_rate[i] + partial[i];
      w_rate[i] = Quad(sign) * w_rate[i] + partial[2 + i];
    }
    const Numbers product = n0 * w_rate;
    Numbers result(2);
    for (std::size_t i = 0; i < 2; ++i)
      result[i] = w_hat_rate[i] - (matrix ? product[i] : exact[i] * w_rate[i]);
    return result;
  };
  rows.reproduced("(59)", "d/dt phi_w at fixed w", exact, ours);
  rows.erratum("(61)", "K^-1 D", pieces(-1, true), pieces(1, true), exact, "(61): it is -K^-1 D");
  // (70) writes dw^/dt, a vector, for the matrix dw^/dw; the reading left is entry by entry.
  rows.erratum("(70), (74)", "(dw^/dt) dw/dt", pieces(1, false), pieces(1, true), exact,
               "(70), (74): the matrix is dw^/dw");
  rows.reproduced("(62)", "alpha_1 = phi_w(alpha_2) on the exact flow", w_hat,
                  part(in_quad(t1, t0, linear_flow<Quad>(*model, tau) * old_z, old_z), 0, 2));
  const Matrix<Quad> flow = linear_flow<Quad>(*model, tau);
  const auto back = at.inverse_blocks(structure(*model, t1, new_z), structure(*model, t0, old_z))(n0);
  const double residual = distance(back.entries(), flow.entries());
  rows.qualitative("(63)", "M in terms of N", "M = sigma_{alpha^-1}", "M = sigma_{alpha^-1}(N)", residual,
                   at_round_off, residual <= at_round_off, "(63): the argument N is missing");
}

// (75), (76): the gradients of phi's coefficients from the scalar equation against the engine's, all up to
// degree 5.
void scalar_equations(Rows& rows) {
  const auto compare = [&](const std::string& equation, const std::string& what, const Model& model,
                           const Tape& scalar, const Numbers& w) {
    const auto phi = expand_scalar(scalar, model.dimension(), 5);
    Numbers theory, engine;
    for (int k = 1; k <= 5; ++k) {
      theory = joined(theory, value(jacobian_tape(phi[static_cast<std::size_t>(k)]), t0, w));
      engine = joined(engine, engine_term(model, k, w));
    }
    rows.reproduced(equation, what, theory, engine);
  };
  const auto henon = systems().get("henon-heiles", "system").make({});
  compare("(75)", "phi_t = -B, Henon-Heiles", *henon, scalar_evolution(*henon->tape(Formula::hamiltonian)),
          {Quad(0.1), Quad(-0.3), Quad(0.25), Quad(0.2)});
  const auto forced = driven(1);
  compare("(76)", "phi_t = -B(.., t), driven", *forced, scalar_evolution(*forced->tape(Formula::hamiltonian)),
          {Quad(0.4), Quad(-0.3)});
  // Nonautonomous: phi_t = -(B + w^.d_t alpha_2 - S_t), S = (E p' r - E0 p r')/2.
  const auto pendulum = damped("damped-pendulum");
  const Tape exact_part = record(5, 1, [](const Recorded& t, Arguments x, Results out) {
    const Recorded rate(Real::fraction(3, 10));
    out[0] = (exp(rate * t) * x[1] * x[2] - exp(rate * x[4]) * x[3] * x[0]) / Recorded(2);
  });
  compare("(73)", "its scalar form, damped pendulum", *pendulum,
          scalar_evolution(*pendulum, chart_alpha(*pendulum), exact_part), {Quad(0.6), Quad(-0.3)});
}

}  // namespace

std::vector<ReproducedRow> evolution_rows() {
  Rows rows("4");
  flow_law(rows);
  theorem(rows);
  scalar_equations(rows);
  return rows.take();
}

}  // namespace pfaff::su_qin
