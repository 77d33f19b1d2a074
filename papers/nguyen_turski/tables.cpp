// Nguyen & Turski, (4.3)-(4.6), tables 1 and 2, appendix B and the other numbers of section 4: chains,
// pendula and the humanoid.
#include <algorithm>
#include <cmath>

#include <pfaff/core/system.hpp>
#include <pfaff/papers/nguyen_turski/rod_samples.hpp>
#include <pfaff/papers/nguyen_turski/rows.hpp>
#include <pfaff/papers/printed/section_4.hpp>
#include <pfaff/papers/printed/tridiagonal.hpp>

namespace pfaff::nguyen_turski {

namespace {

void chains(Rows& rows) {
  const RodSample sample = sample_chain();
  const BeadRodPoint engine = engine_at(sample.description, sample.rods);
  const printed::Rods off = moved(sample.rods, Quad(1) / 32);
  const BeadRodPoint engine_off = engine_at(sample.description, off);
  rows.reproduced("(4.4)", "phi", off.constraints(), engine_off.constraints());
  rows.reproduced("(4.4)", "phi~", off.hidden_constraints(), engine_off.hidden_constraints());
  rows.reproduced("table 1, table 2", "S, tridiagonal", printed::listed(sample.rods.table_s()),
                  engine.s().entries());
  rows.reproduced("table 1, table 2", "A, skew tridiagonal", printed::listed(sample.rods.table_a()),
                  engine.a().entries());
  rows.reproduced("table 1", "S^D, tridiagonal: its inverse",
                  printed::listed(printed::inverse(sample.rods.table_s_friction())),
                  engine.s_friction_inverse().entries());
  const printed::Tridiagonal<Quad> s = printed::tridiagonal(sample.rods.table_s());
  rows.reproduced("(4.6)", "S^-1 of the chain by minors", printed::listed(printed::inverse_by_minors(s)),
                  engine.s_inverse().entries());
  rows.reproduced("metric potential", "log|S| / 2", {log(printed::determinant(sample.rods.table_s())) / 2},
                  {log(determinant(engine.s())) / 2});
}

// Equal beads: (4.5) in m, l, Lambda and the angles.
void equal_beads(Rows& rows) {
  const auto model = systems()
                         .get("chain-molecule", "system")
                         .make({{"beads", "5"},
                                {"mass", "3/2"},
                                {"length", "3/4"},
                                {"friction", "1/5"},
                                {"epsilon", "0"},
                                {"charge", "0"},
                                {"seed", "0"}});
  Numbers z;
  for (const Real& x : model->initial()) z.push_back(x.quad());
  const BeadRodPoint engine(model, z);
  // The zigzag turns by angles whose cosines are 16/25, the last of its rods and the first lying likewise.
  const Numbers cosines(3, Quad(-16) / 25);
  const Quad mass = Quad(3) / 2, length = Quad(3) / 4, friction = Quad(1) / 5;
  rows.reproduced(
      "(4.5)", "S of equal beads",
      printed::listed(printed::equal_beads(2 * length * length / mass, length * length / mass, cosines)),
      engine.s().entries());
  const Quad weight = friction * length * length / (mass * mass);
  rows.reproduced("(4.5)", "S^D of equal beads: its inverse",
                  printed::listed(printed::inverse(printed::equal_beads(2 * weight, weight, cosines))),
                  engine.s_friction_inverse().entries());
}

// (4.3) with both potentials. The engine's epsilon is a quarter of the paper's.
void energies(Rows& rows) {
  RodSample sample = sample_chain();
  sample.description.charges = {Real(1), Real(-2), Real(3), Real(1), Real(-1)};
  PairPotential pair;
  pair.exclude = 1;
  pair.epsilon = Real::fraction(1, 20);
  pair.sigma = Real::fraction(3, 4);
  pair.strength = Real::fraction(1, 3);
  sample.description.pairs = {pair, pair};
  sample.description.pairs.back().kind = PairPotential::Kind::coulomb;
  const BeadRodPoint engine = engine_at(sample.description, sample.rods);
  const printed::PairEnergy potential{{1, -2, 3, 1, -1}, Quad(1) / 3, Quad(1) / 5, Quad(3) / 4};
  const Quad corrected = printed::chain_energy(sample.rods, potential, 1);
  rows.erratum("potential of section 4", "energy of a chain",
               {printed::chain_energy(sample.rods, potential, -1)}, {corrected}, {engine.energy()},
               "potential of section 4: the signs are the other way");
  rows.reproduced("(4.3)", "energy of a chain, corrected potential", {corrected}, {engine.energy()});
}

void pendulum(Rows& rows) {
  const RodSample sample = sample_pendulum(false);
  const printed::Rods off = moved(sample.rods, Quad(1) / 16);
  const BeadRodPoint engine = engine_at(sample.description, off);
  const auto without_last = [](Numbers x) {
    x.pop_back();
    return x;
  };
  rows.erratum("(B.1), (B.3)", "phi of all rods but the last", off.constraints_as_printed(),
               without_last(off.constraints()), without_last(engine.constraints()),
               "(B.1), (B.3): r_{k-1} - r_k, not r_k - r_{k+1}");
  rows.reproduced("(B.1), (B.3)", "corrected: phi", off.constraints(), engine.constraints());
  rows.erratum("(B.2)", "phi~ of all rods but the last", off.hidden_constraints_as_printed(),
               without_last(off.hidden_constraints()), without_last(engine.hidden_constraints()),
               "(B.2): r_{k-1} - r_k, not r_k - r_{k+1}");
  rows.reproduced("(B.2)", "corrected: phi~", off.hidden_constraints(), engine.hidden_constraints());
  rows.reproduced("Hamiltonian of B.1", "energy of the pendulum", {printed::pendulum_energy(off)},
                  {engine.energy()});
  const BeadRodPoint on = engine_at(sample.description, sample.rods);
  rows.reproduced("(B.4), (B.5)", "S of the pendulum", printed::listed(sample.rods.table_s()),
                  on.s().entries());
}

// Friction of bead i in the components that the text before table 1 numbers.
void friction_indices(Rows& rows) {
  const RodSample sample = sample_chain();
  const Numbers lambda = engine_at(sample.description, sample.rods).friction();
  // Of the beads but the last, so that every index printed exists.
  const printed::FrictionIndices indices = printed::friction_indices(sample.rods.beads() - 1, 3);
  Numbers at_printed, at_corrected, claimed;
  for (std::size_t k = 0; k < indices.bead.size(); ++k) {
    at_printed.push_back(lambda[indices.as_printed[k] - 1]);
    at_corrected.push_back(lambda[indices.corrected[k] - 1]);
    claimed.push_back(sample.rods.friction[indices.bead[k] - 1]);
  }
  rows.claim("before table 1", "components of bead i", {"i(d-1)+1 to i(d-1)+d", "d(i-1)+1 to di"},
             {at_least(distance(at_printed, claimed), clearly), at_most(distance(at_corrected, claimed), 0)},
             "before table 1: bead i has the components d(i-1)+1 to di");
}

void humanoid(Rows& rows) {
  const auto model = systems().get("humanoid", "system").make({{"seed", "1"}});
  Numbers z;
  for (const Real& x : model->initial()) z.push_back(x.quad());
  const BeadRodPoint engine(model, z);
  const Matrix<Quad> s = engine.s();
  double beyond = 0;
  for (std::size_t i = 0; i < s.rows(); ++i)
    for (std::size_t j = i + 2; j < s.rows(); ++j)
      beyond = std::max(beyond, std::abs(static_cast<double>(s(i, j))));
  rows.claim("humanoid by (4.6)", "S beyond three diagonals", {"0, tridiagonal", shown(beyond)},
             {at_least(beyond, clearly), is_true(engine.structure() == MatrixStructure::tree)},
             "humanoid by (4.6): S is not tridiagonal, rods branch");
  rows.reproduced("figure 3, 13 points and 24 constraints", "points, constraints in phase space", {13, 24},
                  {Quad(model->dimension() / 6), Quad(static_cast<int>(model->constraint_names().size()))});
}

// The fits of computing times, 0.028 e^{0.49 K} by inversion and 0.00046 e^{1.06 K} by recursion, for which
// the recursion is called good below 12 constraints.
void discussion(Rows& rows) {
  const double at_8 = printed::fitted_recursion(8) / printed::fitted_inversion(8),
               at_7 = printed::fitted_recursion(7) / printed::fitted_inversion(7);
  rows.claim("12 constraints", "recursion quicker than inversion", {"below K = 12", "up to K = 7"},
             {at_least(at_8, 1 + clearly), at_most(at_7, 1 - clearly)},
             "12 constraints: the fits cross between K = 7 and 8");
}

}  // namespace

void table_rows(Rows& rows) {
  chains(rows);
  equal_beads(rows);
  energies(rows);
  pendulum(rows);
  friction_indices(rows);
  humanoid(rows);
  discussion(rows);
}

}  // namespace pfaff::nguyen_turski
