// A pendulum and a chain whose masses, rods and friction differ from bead to bead, so that no index can be
// mistaken for another: for the engine, and the same numbers for the printed formulas.
#pragma once

#include <pfaff/papers/nguyen_turski/bead_rod_point.hpp>
#include <pfaff/papers/printed/rods.hpp>

namespace pfaff::nguyen_turski {

struct RodSample {
  BeadRodDescription description;
  printed::Rods rods;  // q lies on the surface phi = 0, p anywhere
};

/// Four bobs in a plane, K = 4.
RodSample sample_pendulum(bool with_friction);
/// Five beads in space, K = 4, without forces.
RodSample sample_chain();

/// The state of the printed formulas, with positions moved off the surface by numbers of size `off`.
printed::Rods moved(printed::Rods rods, const Quad& off);
/// The engine at that state.
BeadRodPoint engine_at(const BeadRodDescription& description, const printed::Rods& rods);

}  // namespace pfaff::nguyen_turski
