// Nguyen & Turski, (4.1), (4.2), (4.7) and appendix A: constrained motion in Dirac's formulation and with
// Lagrange's multipliers, off the constraints, where the formulations differ. Each formulation of the engine
// is compared with its own equation, written out with dense matrices.
#include <algorithm>
#include <cmath>

#include <pfaff/papers/nguyen_turski/rod_samples.hpp>
#include <pfaff/papers/nguyen_turski/rows.hpp>

namespace pfaff::nguyen_turski {

namespace {

Numbers momenta_of(const Numbers& z) {
  return {z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2), z.end()};
}
Numbers minus(Numbers a, const Numbers& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
  return a;
}

void blocks(Rows& rows, const printed::Motion& motion, const BeadRodPoint& engine) {
  rows.reproduced("(4.1)", "W by blocks", printed::listed(motion.w()), engine.w().entries());
  rows.reproduced("(4.1)", "inverse of W by blocks", printed::listed(motion.w_inverse()),
                  inverse(engine.w()).entries());
}

void equations(Rows& rows, const printed::Motion& motion, const BeadRodPoint& engine) {
  rows.reproduced("(4.2)", "without friction", motion.dirac(false), engine.rates("dirac", "none"));
  rows.reproduced("(4.2)", "with its last line, the friction", motion.dirac(true),
                  engine.rates("dirac", "metriplectic"));
  const Numbers rubbed = engine.rates("dirac", "metriplectic"), free = engine.rates("dirac", "none");
  rows.reproduced("(4.2)", "the last line alone", motion.friction(),
                  minus(momenta_of(rubbed), momenta_of(free)));
  rows.reproduced("(4.7)", "without friction", motion.simplified(false),
                  engine.rates("simplified-dirac", "none"));
  rows.reproduced("(4.7)", "with its last line, the friction", motion.simplified(true),
                  engine.rates("simplified-dirac", "metriplectic"));
  rows.reproduced("(4.7), (A.5)", "without friction it is (A.5)", motion.simplified(false),
                  engine.rates("lmm", "none"));
}

// Appendix A: B and G of the paper are B^T and G of the engine.
void multipliers(Rows& rows, const printed::Motion& motion, const BeadRodPoint& engine) {
  const Numbers rate = engine.rates("lmm", "none"), accelerated = engine.hidden_by_momentum(momenta_of(rate));
  rows.reproduced("(A.1)", "F - M q'' is B lambda", motion.reactions(),
                  minus(engine.force(), momenta_of(rate)));
  rows.reproduced("(A.2)", "rates of phi are B^T q'", motion.first_derivatives(),
                  engine.hidden_constraints());
  Numbers opposite = accelerated;
  for (Quad& x : opposite) x = -x;
  rows.reproduced("(A.3)", "G is -B^T q''", motion.second_derivatives(), opposite);
  rows.reproduced("(A.4)", "lambda", motion.multipliers(), engine.multipliers());
  rows.reproduced("(A.4)", "G + B^T M^-1 F", motion.hidden_rates(), engine.hidden_rates());
  rows.reproduced("(A.5)", "multipliers from the second derivatives", motion.lagrange(), rate);
}

// (4.7) is called equivalent to (4.2).
void equivalence(Rows& rows, const RodSample& sample) {
  const printed::Rods off = moved(sample.rods, Quad(1) / 16);
  const double apart = distance(printed::Motion(off).simplified(false),
                                engine_at(sample.description, off).rates("dirac", "none"));
  // On the surface: bobs at rest.
  printed::Rods on = sample.rods;
  std::fill(on.p.begin(), on.p.end(), Quad(0));
  const double together = distance(printed::Motion(on).simplified(false),
                                   engine_at(sample.description, on).rates("dirac", "none"));
  rows.claim("(4.7)", "equivalent to (4.2)", {"equivalent", "only where phi~ = 0"},
             {at_least(apart, clearly), at_most(together, at_round_off)}, "(4.7): only where phi~ = 0");
}

// Friction proportional to velocity, with constraint forces that do no work, dissipates v.Lambda v.
void friction(Rows& rows, const RodSample& sample) {
  printed::Rods on = sample.rods;
  // Velocities of a rotation about the origin keep the rods.
  for (std::size_t i = 0; i < on.beads(); ++i) {
    on.p[2 * i] = -(on.masses[i] * on.q[2 * i + 1]);
    on.p[2 * i + 1] = on.masses[i] * on.q[2 * i];
  }
  const Numbers v = on.velocity(), lambda = on.coefficients(), force = printed::Motion(on).friction();
  Quad drag(0), bracket(0);
  for (std::size_t k = 0; k < v.size(); ++k) {
    drag -= lambda[k] * v[k] * v[k];
    bracket += v[k] * force[k];
  }
  const BeadRodPoint engine = engine_at(sample.description, on);
  rows.erratum("after (4.2)", "dH/dt by damping proportional to velocity", {drag}, {bracket},
               {engine.energy_rate("dirac", "metriplectic")},
               "after (4.2): it is such damping only for special friction");
  rows.reproduced("after (4.2)", "dH/dt by such damping, ideal constraint forces", {drag},
                  {engine.energy_rate("dirac", "stokes")});
}

}  // namespace

void motion_rows(Rows& rows) {
  const RodSample sample = sample_pendulum(true), free = sample_pendulum(false);
  const printed::Rods off = moved(sample.rods, Quad(1) / 16);
  const printed::Motion motion(off);
  const BeadRodPoint engine = engine_at(sample.description, off);
  blocks(rows, motion, engine);
  equations(rows, motion, engine);
  multipliers(rows, motion, engine);
  equivalence(rows, free);
  friction(rows, sample);
}

}  // namespace pfaff::nguyen_turski
