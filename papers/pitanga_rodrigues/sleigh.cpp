// Pitanga & Rodrigues 4.1, (27) to (35): the Chaplygin-Caratheodory sleigh.
#include <pfaff/brackets/almost_product/independence.hpp>
#include <pfaff/papers/pitanga_rodrigues/engine_point.hpp>
#include <pfaff/papers/pitanga_rodrigues/rows.hpp>
#include <pfaff/papers/printed/projectors.hpp>
#include <pfaff/papers/printed/sleigh.hpp>

namespace pfaff::pitanga_rodrigues {

namespace {

using Formulas = printed::SleighFormulas<Quad>;

// The velocity of the contact point (x, y) - r (cos theta, sin theta) along the blade and across it, by
// duals.
Numbers contact_velocity(const Numbers& q, const Numbers& v) {
  using D = Dual<Quad, 1>;
  std::vector<D> moving(q.begin(), q.end());
  for (std::size_t k = 0; k < moving.size(); ++k) moving[k].derivative[0] = v[k];
  const D r(sleigh_distance), x = moving[0] - r * cos(moving[2]), y = moving[1] - r * sin(moving[2]);
  const Quad c = cos(q[2]), s = sin(q[2]), dx = x.derivative[0], dy = y.derivative[0];
  return {c * dx + s * dy, c * dy - s * dx};
}

void kinematics(Rows& rows, const EnginePoint& engine, const Formulas& formulas) {
  // A velocity that does not keep the constraint, and its momenta.
  const Numbers v{Quad(4) / 3, Quad(-1) / 2, Quad(3) / 5};
  Numbers off = engine.q();
  off.insert(off.end(), {v[0], v[1], sleigh_inertia * v[2]});
  const Numbers contact = contact_velocity(engine.q(), v);
  rows.reproduced("(27)", "u, the speed along the blade", {formulas.along(v)}, {contact[0]});
  rows.reproduced("(28)", "v, the speed across it", {formulas.across(v)}, {contact[1]});
  rows.erratum(
      "position of the sleigh", "the speed across the blade of the point (x, y)",
      {v[1] * formulas.c - v[0] * formulas.s}, {formulas.across(v)}, engine.constraints(off),
      "position of the sleigh: (x, y) is the centre of mass, as in (29) and (32), and not the knife edge");
  rows.reproduced("(29)", "v, of the engine's constraint", {formulas.across(v)}, engine.constraints(off));
  rows.reproduced("(29)", "v = 0 on the constraint", {formulas.across(engine.velocity())}, zeros(1));
  const auto structure = engine.projectors();
  rows.reproduced("(30)", "the one-form on a displacement", {formulas.displaced(v)},
                  {pairing(structure.one_forms()[0], TangentVector<Quad>(v))});
  rows.reproduced("(30)", "on a virtual displacement",
                  {formulas.displaced((structure.admissible() * TangentVector<Quad>(v)).components())},
                  zeros(1));
  rows.reproduced("(31)", "A", formulas.row(), structure.one_forms()[0].components());
  rows.reproduced("(32)", "L = T", {formulas.lagrangian(engine.velocity())}, {engine.energy()});
  rows.reproduced("(33)", "g", printed::listed(formulas.metric()), engine.metric().entries());
}

void projector(Rows& rows, const EnginePoint& engine, const Formulas& formulas) {
  const auto structure = engine.projectors();
  const Matrix<Quad>& q = structure.complement().matrix();
  const Metric<Quad> metric(engine.metric());
  rows.reproduced("Q of the sleigh", "Q", printed::listed(formulas.q()), q.entries());
  const TangentVector<Quad> x = metric.sharp() * structure.one_forms()[0];
  const Quad g = pairing(structure.one_forms()[0], x);
  rows.reproduced("Remark 2", "X", formulas.x(), x.components());
  rows.reproduced("Remark 2", "G = alpha(X)", {formulas.g()}, {g});
  rows.reproduced("Remark 2", "|X|^2 = G", {formulas.g()}, {value_on(metric.flat(), x, x)});
  // g* X is the covector alpha, so that what is printed is alpha (x) alpha.
  const auto product = [&](const Numbers& left) {
    Numbers entries;
    for (const Quad& l : left)
      for (const Quad& r : formulas.alpha()) entries.push_back(l * r);
    return entries;
  };
  Numbers shortened = formulas.x();
  for (Quad& component : shortened) component = component / formulas.g();
  rows.erratum("Remark 2", "Q = g* X (x) alpha", product(printed::product(formulas.metric(), formulas.x())),
               product(shortened), q.entries(), "Remark 2: Q = G^-1 X (x) alpha, whose trace is 1");
}

void motion(Rows& rows, const EnginePoint& engine, const Formulas& formulas) {
  const Numbers& a = engine.acceleration();
  const Numbers v = engine.velocity();
  rows.reproduced("(34)", "z'' = Q z''", printed::product(formulas.q(), a), a);
  // The rank of z'' = Q z'' alone, and with A z'' + A' v = 0.
  const auto structure = engine.projectors();
  const Matrix<Quad> p = structure.admissible().matrix();
  Matrix<Quad> completed(4, 3);
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) completed(i, j) = p(i, j);
    completed(3, j) = structure.one_forms()[0][j];
  }
  const double alone = static_cast<double>(detail::rank_of(p)),
               together = static_cast<double>(detail::rank_of(completed));
  rows.claim("(34)", "gives the motion alone",
             {"three equations", "rank 2 of 3; with the derivative of (29), 3"},
             {at_most(alone, 2), at_least(together, 3)}, "(34): complete it by A z'' + A' v = 0");
  // u' and omega' of the engine's motion: u = x' cos + y' sin.
  const Quad u = formulas.along(v), omega = v[2],
             u_rate = a[0] * formulas.c + a[1] * formulas.s + omega * (v[1] * formulas.c - v[0] * formulas.s);
  rows.reproduced("(35)", "omega' and u'", formulas.rates(u, omega), {a[2], u_rate});
}

void momenta(Rows& rows, const EnginePoint& engine, const Formulas& formulas) {
  Numbers off = engine.state();
  off[3] += Quad(1) / 3;
  off[5] += Quad(1) / 7;
  rows.reproduced("Hamiltonian of the sleigh", "the constraint of the momenta",
                  {formulas.momentum_constraint(EnginePoint::second_half(off))}, engine.constraints(off));
  rows.reproduced("Hamiltonian of the sleigh", "H", {formulas.hamiltonian(engine.p())}, {engine.energy()});
  const Numbers flow = engine.tensor() * engine.energy_slopes();
  const Numbers v = engine.velocity();
  const Quad omega = v[2], u_rate = flow[3] * formulas.c + flow[4] * formulas.s +
                                    omega * (v[1] * formulas.c - v[0] * formulas.s);
  rows.reproduced("Hamiltonian of the sleigh", "(35) from the bracket of (41)",
                  formulas.rates(formulas.along(v), omega), {flow[5] / sleigh_inertia, u_rate});
}

}  // namespace

void sleigh_rows(Rows& rows) {
  const EnginePoint engine(sleigh_model(), Quad(0),
                           {Quad(1), Quad(-2), Quad(7) / 10, Quad(3) / 4, Quad(5) / 3, Quad(2) / 5});
  const Formulas formulas{engine.q()[2], sleigh_inertia, sleigh_distance};
  kinematics(rows, engine, formulas);
  projector(rows, engine, formulas);
  motion(rows, engine, formulas);
  momenta(rows, engine, formulas);
}

}  // namespace pfaff::pitanga_rodrigues
