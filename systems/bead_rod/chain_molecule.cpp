// A free chain of beads joined by rigid rods (nguyen-turski (4.3), (4.4)), with Lennard-Jones forces, charges
// of alternating sign and friction. It starts as a zigzag, in space as a helix, with bonds at 106 degrees.
#include <pfaff/systems/bead_rod/system.hpp>

namespace {
using namespace pfaff;

struct ChainMolecule : BeadRods<ChainMolecule> {
  int beads = 8, axes = 3, exclude = 1, seed = 1;
  Real mass = 1, length = 1, epsilon = 0.2_r, sigma = 1, charge = 0.3_r, strength = 1, cutoff = 0, drag = 0,
       gravity = 0;
  static std::vector<Parameter> parameters() {
    using S = ChainMolecule;
    return {parameter(&S::beads, "beads", "", 2, 1000000, "number of beads"),
            parameter(&S::axes, "dimension", "", 2, 3, "of space"),
            parameter(&S::mass, "mass", "kg", 1e-6, 1e6, "of each bead"),
            parameter(&S::length, "length", "m", 1e-6, 1e6, "of each rod"),
            parameter(&S::epsilon, "epsilon", "J", 0, 1e6, "depth of Lennard-Jones's potential; 0: none"),
            parameter(&S::sigma, "sigma", "m", 1e-6, 1e6, "its distance of zero energy"),
            parameter(&S::charge, "charge", "", 0, 1e6, "of the beads, with alternating signs; 0: none"),
            parameter(&S::strength, "strength", "J m", -1e6, 1e6, "of Coulomb's potential, for charges of 1"),
            parameter(&S::cutoff, "cutoff", "m", 0, 1e6, "of both potentials; 0: none, all pairs act"),
            parameter(&S::exclude, "exclude", "", 0, 16, "pairs joined by so many rods do not act"),
            parameter(&S::drag, "friction", "kg/s", 0, 1e3, "of each bead"),
            parameter(&S::gravity, "gravity", "m/s^2", -1e3, 1e3, "against the last axis"),
            parameter(&S::seed, "seed", "", 0, 1000000000, "of the velocities at the start; 0: at rest")};
  }
  [[nodiscard]] BeadRodDescription describe() const {
    BeadRodDescription d;
    d.origin = "system chain-molecule";
    d.dimension = axes;
    const auto count = static_cast<std::size_t>(beads);
    d.masses.assign(count, mass);
    if (!drag.is(0)) d.friction.assign(count, drag);
    if (!gravity.is(0)) {
      d.gravity.assign(d.axes(), 0);
      d.gravity.back() = -gravity;
    }
    PairPotential pair;
    if (!cutoff.is(0)) pair.cutoff = cutoff;
    pair.exclude = exclude;
    pair.epsilon = epsilon;
    pair.sigma = sigma;
    pair.strength = strength;
    if (!epsilon.is(0)) d.pairs.push_back(pair);
    pair.kind = PairPotential::Kind::coulomb;
    if (!charge.is(0)) {
      for (std::size_t i = 0; i < count; ++i) d.charges.push_back(i % 2 == 0 ? charge : -charge);
      if (!strength.is(0)) d.pairs.push_back(pair);
    }
    std::vector<Real> place(d.axes(), 0);
    for (std::size_t i = 0; i < count; ++i) {
      d.positions.insert(d.positions.end(), place.begin(), place.end());
      if (i + 1 < count) d.rods.push_back({i, i + 1, length});
      // Rods (4, +-3, 0)/5 in turn with (4, 0, +-3)/5: up, out, down, in.
      const std::size_t across = axes == 3 ? 1 + i % 2 : 1;
      const bool back = axes == 3 ? i % 4 >= 2 : i % 2 == 1;
      place[0] = place[0] + Real::fraction(4, 5) * length;
      place[across] = place[across] + Real::fraction(back ? -3 : 3, 5) * length;
    }
    d.momenta.assign(count * d.axes(), 0);
    if (seed != 0) start_at_random(d, seed);
    return d;
  }
};

const System<ChainMolecule> registered{
    {.name = "chain-molecule",
     .title = "free chain of beads on rigid rods, with Lennard-Jones and Coulomb forces",
     .reference = "nguyen-turski (4.3), (4.4)",
     .description = "A free chain of beads on rigid rods with Lennard-Jones and Coulomb forces and friction, "
                    "as in models of polymers. Take it to compare formulations and methods in three "
                    "dimensions with forces between all pairs, which cost more than the constraints from a "
                    "few dozen beads on. Beads that come close make the motion stiff."}};
}  // namespace
