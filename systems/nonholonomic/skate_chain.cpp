// A chain of N beads on rigid rods on an inclined plane, pinned at the origin, with a skate under bead m =
// N/2 (rounded down; beads count from 0) that points along the rod before it:
//
//   H = sum_i |p_i|^2/(2 m) + m g sum_i y_i,   phi_k = (|D_k|^2 - l^2)/2 with D_k = r_k - r_{k-1}, r_{-1} = 0
//   D_m x v_m = 0: the velocity of the bead has no part across the rod
//
// Holonomic constraints and one of velocities act together. Each bead that follows the skate adds a rod and
// two coordinates, so that N - 1 degrees of freedom are left. S couples neighbouring rods, and the skate with
// the rod after its bead; it is perpendicular to the one before. Right-hand sides take O(N): the rods are
// those of all bead-rod systems, to which the skate is joined (core/facets/joined_velocity_constraints.hpp).
//
// The constraints are independent everywhere. Methods that keep velocity constraints keep the rods at the
// level of velocities alone; their lengths are off by the error of the method.
#include <pfaff/systems/bead_rod/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

struct SkateChain : BeadRodSystem<SkateChain> {
  static constexpr int velocity_constraint_count = 1;
  int beads = 4;
  Real mass = 1, length = 1, gravity = 1;
  static std::vector<Parameter> parameters() {
    using S = SkateChain;
    return {parameter(&S::beads, "beads", "", 2, 1000000, "number of beads, and of rods"),
            parameter(&S::mass, "mass", "kg", 1e-6, 1e6, "of each bead"),
            parameter(&S::length, "length", "m", 1e-6, 1e6, "of each rod"),
            parameter(&S::gravity, "gravity", "m/s^2", -1e3, 1e3, "its part along the plane, against y")};
  }
  static std::vector<Assignments> instances(bool full) {
    if (full) return {{}, {{"beads", "2"}}, {{"beads", "5"}, {"mass", "0.5"}, {"length", "2"}}};
    return {{{"beads", "3"}}};
  }
  static std::vector<std::string> velocity_constraint_names() { return {"skate"}; }
  // Momenta that the rods alone would keep are not kept: the skate pushes.
  [[nodiscard]] static Momenta momenta() { return {}; }

  // Rods in directions (3, -4)/5 and (4, -3)/5 by turns, which turn at 2 and -6/5 rad/s by turns; that at
  // the skate turns as the skate lets it.
  [[nodiscard]] BeadRodDescription describe() const {
    BeadRodDescription d;
    d.origin = "system skate-chain";
    d.dimension = 2;
    const auto count = static_cast<std::size_t>(beads);
    d.masses.assign(count, mass);
    if (!gravity.is(0)) d.gravity = {0, -gravity};
    d.anchors = {{"origin", {0, 0}}};
    Real x = 0, y = 0, u = 0, v = 0;
    for (std::size_t k = 0; k < count; ++k) {
      d.rods.push_back({k, k == 0 ? count : k - 1, length});
      const Real c = Real::fraction(k % 2 == 0 ? 3 : 4, 5), s = Real::fraction(k % 2 == 0 ? -4 : -3, 5);
      Real speed = length * (k % 2 == 0 ? Real(2) : Real::fraction(-6, 5));  // along (-s, c)
      if (k == skated(count)) speed = s * u - c * v;
      x = x + length * c;
      y = y + length * s;
      u = u - s * speed;
      v = v + c * speed;
      d.positions.push_back(x);
      d.positions.push_back(y);
      d.momenta.push_back(mass * u);
      d.momenta.push_back(mass * v);
    }
    return d;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    const std::size_t at = 2 * skated(q.size() / 2);  // its x; the bead before it stands two places ahead
    rows[at] = q[at - 1] - q[at + 1];
    rows[at + 1] = q[at] - q[at - 2];
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }

 private:
  static std::size_t skated(std::size_t count) { return count / 2; }
};

const System<SkateChain> registered{
    {.name = "skate-chain",
     .title = "chain of beads on rigid rods on an inclined plane, with a skate under one of them",
     .reference = "neimark-fufaev1972",
     .description =
         "A pinned chain of beads on rigid rods on an inclined plane, with a skate under the bead in the "
         "middle that points along the rod before it. Take it for holonomic constraints and one of "
         "velocities "
         "together, at any size: a right-hand side takes O(beads). Methods for velocity constraints keep the "
         "rods at the level of velocities, and their lengths only as well as they are accurate."}};
}  // namespace
