// A closed chain of beads and rods, free, starting as a regular polygon with velocities that the rods allow.
#include <pfaff/systems/bead_rod/system.hpp>

namespace {
using namespace pfaff;

struct Ring : BeadRods<Ring> {
  int beads = 8, axes = 2, seed = 1;
  Real mass = 1, length = 1, gravity = 0, drag = 0;
  static std::vector<Parameter> parameters() {
    return {parameter(&Ring::beads, "beads", "", 4, 1000000, "number of beads, and of rods"),
            parameter(&Ring::axes, "dimension", "", 2, 3, "of space"),
            parameter(&Ring::mass, "mass", "kg", 1e-6, 1e6, "of each bead"),
            parameter(&Ring::length, "length", "m", 1e-6, 1e6, "of each rod"),
            parameter(&Ring::gravity, "gravity", "m/s^2", -1e3, 1e3, "against the last axis"),
            parameter(&Ring::drag, "friction", "kg/s", 0, 1e3, "of each bead"),
            parameter(&Ring::seed, "seed", "", 0, 1000000000, "of the velocities at the start; 0: at rest")};
  }
  [[nodiscard]] BeadRodDescription describe() const {
    BeadRodDescription d;
    d.origin = "system ring";
    d.dimension = axes;
    const auto count = static_cast<std::size_t>(beads);
    d.masses.assign(count, mass);
    if (!drag.is(0)) d.friction.assign(count, drag);
    if (!gravity.is(0)) {
      d.gravity.assign(d.axes(), 0);
      d.gravity.back() = -gravity;
    }
    const Real pi = 3.14159265358979323846264338327950288_r;
    const Real radius = length / (2 * sin(pi / beads));
    d.positions.assign(count * d.axes(), 0);
    for (std::size_t i = 0; i < count; ++i) {
      const Real angle = 2 * pi * Real::fraction(static_cast<std::int64_t>(i), beads);
      d.positions[i * d.axes()] = radius * cos(angle);
      d.positions[i * d.axes() + 1] = radius * sin(angle);
      d.rods.push_back({i, (i + 1) % count, length});
    }
    d.momenta.assign(count * d.axes(), 0);
    if (seed != 0) start_at_random(d, seed);
    return d;
  }
};

const System<Ring> registered{
    {.name = "ring",
     .title = "closed chain of beads on rigid rods",
     .reference = "nguyen-turski section 4",
     .description =
         "A closed chain of beads and rods, free in space, started as a regular polygon. Take it as the case "
         "where S is cyclic, with conserved momenta and angular momenta. Without gravity and friction it "
         "only turns and flexes; in the plane a polygon with all rods on one line is a singular position."}};
}  // namespace
