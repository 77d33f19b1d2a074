// The four-bar linkage: a crank and a rocker on two anchors, joined by a coupler (the fourth bar is the
// ground), with masses at its two moving joints, in the plane. Crank and rocker stand upright at the start.
#include <pfaff/systems/bead_rod/system.hpp>

namespace {
using namespace pfaff;

struct FourBar : BeadRods<FourBar> {
  int seed = 1;
  Real ground = 2, crank = 1, rocker = 1.5_r, mass = 1, gravity = 9.81_r, drag = 0;
  static std::vector<Parameter> parameters() {
    return {
        parameter(&FourBar::ground, "ground", "m", 1e-3, 1e3, "distance of the anchors"),
        parameter(&FourBar::crank, "crank", "m", 1e-3, 1e3, "length"),
        parameter(&FourBar::rocker, "rocker", "m", 1e-3, 1e3, "length"),
        parameter(&FourBar::mass, "mass", "kg", 1e-6, 1e6, "of each joint"),
        parameter(&FourBar::gravity, "gravity", "m/s^2", -1e3, 1e3),
        parameter(&FourBar::drag, "friction", "kg/s", 0, 1e3, "of each joint"),
        parameter(&FourBar::seed, "seed", "", 0, 1000000000, "of the velocities at the start; 0: at rest")};
  }
  [[nodiscard]] BeadRodDescription describe() const {
    BeadRodDescription d;
    d.origin = "system four-bar";
    d.masses = {mass, mass};
    if (!drag.is(0)) d.friction = {drag, drag};
    d.gravity = {0, -gravity};
    d.anchors = {{"left", {0, 0}}, {"right", {ground, 0}}};
    d.positions = {0, crank, ground, rocker};
    d.rods = {{0, 2, crank}, {0, 1, d.distance(0, 1)}, {1, 3, rocker}};
    d.momenta.assign(4, 0);
    if (seed != 0) start_at_random(d, seed);
    return d;
  }
};

const System<FourBar> registered{
    {.name = "four-bar",
     .title = "four-bar linkage: a closed loop of three rods and the ground",
     .reference = "nguyen-turski section 4",
     .description = "Crank, coupler and rocker on two anchors, a closed loop with one degree of freedom. "
                    "Take it as the smallest mechanism with a loop. Where all bars of a linkage fall on one "
                    "line the constraints depend on each other: near such a position S is nearly singular "
                    "and every formulation loses digits."}};
}  // namespace
