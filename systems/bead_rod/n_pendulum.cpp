// The pendulum of N bobs, each hanging by a rod from the one before, the first from the origin (nguyen-turski
// (B.1)-(B.5)). It starts on the x axis; with a seed, with random velocities that the rods allow.
#include <pfaff/systems/bead_rod/system.hpp>

namespace {
using namespace pfaff;

struct NPendulum : BeadRods<NPendulum> {
  int bobs = 4, axes = 2, seed = 1;
  Real mass = 1, length = 1, gravity = 9.81_r, drag = 0;
  static std::vector<Parameter> parameters() {
    return {
        parameter(&NPendulum::bobs, "bobs", "", 1, 1000000, "number of bobs"),
        parameter(&NPendulum::axes, "dimension", "", 2, 3, "of space"),
        parameter(&NPendulum::mass, "mass", "kg", 1e-6, 1e6, "of each bob"),
        parameter(&NPendulum::length, "length", "m", 1e-6, 1e6, "of each rod"),
        parameter(&NPendulum::gravity, "gravity", "m/s^2", -1e3, 1e3, "against the last axis"),
        parameter(&NPendulum::drag, "friction", "kg/s", 0, 1e3, "of each bob"),
        parameter(&NPendulum::seed, "seed", "", 0, 1000000000, "of the velocities at the start; 0: at rest")};
  }
  // In space, one bob, and with friction.
  static std::vector<Assignments> instances(bool /*full*/) {
    return {{}, {{"bobs", "1"}}, {{"bobs", "2"}, {"dimension", "3"}}, {{"friction", "0.5"}}};
  }
  [[nodiscard]] BeadRodDescription describe() const {
    BeadRodDescription d;
    d.origin = "system n-pendulum";
    d.dimension = axes;
    const auto count = static_cast<std::size_t>(bobs);
    d.masses.assign(count, mass);
    if (!drag.is(0)) d.friction.assign(count, drag);
    d.gravity.assign(d.axes(), 0);
    d.gravity.back() = -gravity;
    d.anchors = {{"origin", std::vector<Real>(d.axes(), 0)}};
    d.positions.assign(count * d.axes(), 0);
    for (std::size_t k = 0; k < count; ++k) {
      d.rods.push_back({k, k == 0 ? count : k - 1, length});
      d.positions[k * d.axes()] = static_cast<int>(k + 1) * length;
    }
    d.momenta.assign(count * d.axes(), 0);
    if (seed != 0) start_at_random(d, seed);
    return d;
  }
};

const System<NPendulum> registered{
    {.name = "n-pendulum",
     .title = "pendulum of N bobs on rigid rods, in a plane or in space",
     .reference = "nguyen-turski (B.1)-(B.5)",
     .description = "A chain of N bobs on rigid rods, hanging from a point, in the plane or in space. Take "
                    "it to see how cost and accuracy scale with the number of constraints: S is tridiagonal "
                    "and solved in linear time. Long chains are chaotic within a few swings, and only energy "
                    "and momenta can be compared after that."}};
}  // namespace
