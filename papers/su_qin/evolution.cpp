// Su & Qin, section 4, (56)-(76): the flow's law, the evolution of the generating function (Theorem 4.1) on
// the exact flow of the damped oscillator, the Hamilton-Jacobi equations.
#include <functional>

#include <pfaff/integrators/generating/lagrangian_transformation.hpp>
#include <pfaff/papers/printed/generating.hpp>
#include <pfaff/papers/printed/oscillator.hpp>
#include <pfaff/papers/su_qin/papers_alpha.hpp>
#include <pfaff/papers/su_qin/rows.hpp>

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

// (56): the flow of q'' = t, for which three Gauss stages are exact. The paper's g^t starts at the time 0.
void flow_law(Rows& rows) {
  const auto model = driven(0);
  const auto method = integrators().get("gauss", "integrator").make({{"stages", "3"}});
  StepDifferentiator<Quad> differentiate(*method, model);
  // From `from` to `to`, by the solution q'' = t in closed form.
  const auto g = [](const Quad& to, const Quad& from, const Numbers& z) -> Numbers {
    const Quad h = to - from;
    return {z[0] + h * z[1] + from * h * h / 2 + h * h * h / 6, z[1] + (to * to - from * from) / 2};
  };
  const Numbers z{Quad(0.3), Quad(-0.2)};
  const Quad zero(0), a(0.5), b(0.75);
  rows.erratum("(56)", "g^{t1+t2} = g^{t1} g^{t2}", g(b, zero, g(a, zero, z)), g(a + b, a, g(a, zero, z)),
               differentiate(zero, a + b, z).z, "(56): g(t2,t1) g(t1,t0) = g(t2,t0)");
}

// Theorem 4.1 on the exact flow of the oscillator. Ours is d/dt N(t) w with N = sigma(M(t)) of the engine, at
// fixed w, by dual numbers; it knows nothing of (61). Printed are the pieces of (61) and (69) with (94)-(96).
void theorem(Rows& rows) {
  using D = Dual<Quad, 1>;
  const auto model = damped("damped-oscillator");
  const auto recorded = shared(record_alpha(PapersAlpha{}, 2));
  LagrangianTransformation<D> alpha(recorded);
  const std::vector<D> anywhere(2);
  const Matrix<D> m = linear_flow<D>(*model, D::variable(tau, 0));
  const FractionalTransformation<D> blocks = alpha.blocks(D::variable(t1, 0), D(t0), anywhere, anywhere);
  const Matrix<D> n = blocks(m);
  const Numbers w{Quad(0.6), Quad(-0.3)};
  Numbers ours(2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) ours[i] += n(i, j).derivative[0] * w[j];

  const printed::Oscillator printed(nu, t0, t1);
  const printed::Blocks b = printed::blocks_of(printed.alpha_jacobian());
  const auto n0 = printed::fractional(b, printed.flow());
  const Numbers w_hat = printed::product(n0, w),
                states = printed.alpha_inverse(joined(w_hat, w), printed::Form::corrected),
                new_z = part(states, 0, 2), field = printed.field(new_z), partial = printed.alpha_rate(new_z);
  // (61) and (69): A K^-1 g + d_t alpha_1 - N (C K^-1 g + d_t alpha_2), with sign -1 for K^-1 D in place of
  // K^-1 g.
  const auto rate = [&](int sign) {
    Numbers velocity = field;
    for (Quad& x : velocity) x *= Quad(sign);
    Numbers first = printed::product(b.a, velocity), second = printed::product(b.c, velocity);
    for (std::size_t i = 0; i < 2; ++i) {
      first[i] += partial[i];
      second[i] += partial[2 + i];
    }
    const Numbers moved = printed::product(n0, second);
    return Numbers{first[0] - moved[0], first[1] - moved[1]};
  };
  const Numbers total = printed.alpha_total_rate(joined(w_hat, w)),
                moved = printed::product(n0, part(total, 2, 2));
  rows.reproduced("(59), Theorem 4.1", "d/dt phi_w at fixed w, by (99)",
                  {total[0] - moved[0], total[1] - moved[1]}, ours);
  rows.erratum("(61)", "K^-1 D", rate(-1), rate(1), ours, "(61): it is -K^-1 D");
  rows.reproduced("(69)", "rates of w^ and w", rate(1), ours);
  // (70) and (74) write dw^/dt, a vector, where the matrix dw^/dw belongs.
  rows.qualitative("(70), (74)", "(dw^/dt) dw/dt, vectors", {"no product", shown(rate(1))},
                   {at_most(distance(rate(1), ours), at_round_off)}, "(70), (74): the matrix is dw^/dw");
  rows.reproduced("(67)", "z' = K^-1 (grad B + F_t)",
                  printed::product(printed.k0_inverse(), printed.right_side({Quad(0.4), Quad(-0.7)})),
                  value(*model->derived(Formula::field), t0, {Quad(0.4), Quad(-0.7)}));
  // (57): at t = t0 and z^ = z, with the engine's blocks.
  LagrangianTransformation<Quad> in_quad(recorded);
  const printed::Oscillator start(nu, t0, t0);
  const auto at_start =
      printed::denominator(printed::blocks_of(start.alpha_jacobian()), printed::unit_table<Quad>(2));
  const Numbers z{Quad(0.5), Quad(0.1)};
  const Quad ours_at_start = determinant(in_quad.blocks(t0, t0, z, z).denominator(Matrix<Quad>::identity(2)));
  rows.reproduced("(57)", "|C + D| at the identity", {printed::determinant(at_start)}, {ours_at_start});
  const Numbers after = linear_flow<Quad>(*model, tau) * z, pair = printed.alpha(after, z);
  Matrix<Quad> n_engine(2, 2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) n_engine(i, j) = n(i, j).value;
  rows.reproduced("(62)", "alpha_1 = phi_w(alpha_2) on the exact flow", {pair[0], pair[1]},
                  n_engine * Numbers{pair[2], pair[3]});
  // (63): M from N by the blocks of (98).
  const auto back = printed::fractional(printed::blocks_of(printed.alpha_inverse_jacobian()), n0);
  rows.reproduced("(63)", "N = sigma(M)", printed::listed(n0), n_engine.entries());
  rows.qualitative(
      "(63)", "M in terms of N", {"M = sigma_{alpha^-1}", "M = sigma_{alpha^-1}(N)"},
      {at_most(distance(printed::listed(back), linear_flow<Quad>(*model, tau).entries()), at_round_off)},
      "(63): the argument N is missing");
}

using printed::TauSeries;
using printed::TrigonometricPolynomial;

// w_k and the series of y^_k - w_k: the new state of the chart.
TauSeries new_state(std::size_t k, TauSeries shift) {
  shift[0] = shift[0] + TrigonometricPolynomial::variable(k);
  return shift;
}

// (73), (75), (76): the gradients of phi's coefficients from the scalar equation, in closed form, against the
// engine's, all up to degree 5.
void scalar_equations(Rows& rows) {
  constexpr int degree = 5;
  const auto compare = [&](const std::string& equation, const std::string& what, const Model& model,
                           const std::function<TauSeries(const std::vector<TauSeries>&)>& energy,
                           const Numbers& w) {
    const auto phi = printed::coefficients(w.size(), degree, energy);
    Numbers theory, engine;
    for (int k = 1; k <= degree; ++k) {
      for (std::size_t i = 0; i < w.size(); ++i)
        theory.push_back(phi[static_cast<std::size_t>(k)].slope(i).at(w));
      engine = joined(engine, engine_term(model, k, w));
    }
    rows.reproduced(equation, what, theory, engine);
  };
  const Quad half = Quad(1) / Quad(2), third = Quad(1) / Quad(3);
  // H = (|q|^2 + |p|^2)/2 + q_0^2 q_1 - q_1^3/3.
  const auto henon_heiles = [&](const std::vector<TauSeries>& shift) {
    std::vector<TauSeries> y;
    for (std::size_t k = 0; k < 4; ++k) y.push_back(new_state(k, shift[k]));
    return half * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]) + y[0] * y[0] * y[1] +
           -third * (y[1] * y[1] * y[1]);
  };
  const auto henon = systems().get("henon-heiles", "system").make({});
  compare("(75)", "phi_t = -B, Henon-Heiles", *henon, henon_heiles,
          {Quad(0.1), Quad(-0.3), Quad(0.25), Quad(0.2)});
  // H = p^2/2 - t q + q^3/3.
  const auto with_time = [&](const std::vector<TauSeries>& shift) {
    const TauSeries q = new_state(0, shift[0]), p = new_state(1, shift[1]);
    TauSeries time(q.size());
    time[0] = t0;
    time[1] = Quad(1);
    return half * (p * p) + Quad(-1) * (time * q) + third * (q * q * q);
  };
  compare("(76)", "phi_t = -B(.., t), driven", *driven(1), with_time, {Quad(0.4), Quad(-0.3)});
  // phi_t = -(B + w^.d_t alpha_2 - S_t), S = (E p' r - E0 p r')/2, where E = e^{nu t}, y^ = (r', E p'), y = w
  // + (w - y^) the old state, w^ = (.., -(y^_0 - y_0)), B = E (p'^2 + nu p' r')/2 - E cos r'.
  const auto damped_pendulum = [&](const std::vector<TauSeries>& shift) {
    const TauSeries r = new_state(0, shift[0]), ep = new_state(1, shift[1]),
                    old_r = new_state(0, Quad(-1) * shift[0]);
    const TauSeries e = printed::exponential(nu, t0, r.size()),
                    inverse = printed::exponential(-nu, t0, r.size());
    const TauSeries b =
        half * (inverse * ep * ep + nu * (ep * r)) + Quad(-1) * (e * printed::sine_at(shift[0], 1));
    const TauSeries second_of_w_hat = old_r + Quad(-1) * r, rate_of_alpha_2 = nu * half * ep,
                    rate_of_s = nu * half * (ep * old_r);
    return b + second_of_w_hat * rate_of_alpha_2 + Quad(-1) * rate_of_s;
  };
  compare("(73)", "its scalar form, damped pendulum", *damped("damped-pendulum"), damped_pendulum,
          {Quad(0.6), Quad(-0.3)});
}

}  // namespace

void evolution_rows(Rows& rows) {
  flow_law(rows);
  theorem(rows);
  scalar_equations(rows);
}

}  // namespace pfaff::su_qin
