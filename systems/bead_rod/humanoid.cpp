// A standing figure of 13 points and 12 rods (nguyen-turski section 4): head 0, shoulders' level 1, arms
// 2-3-4 and 5-6-7 (shoulder, elbow, wrist), pelvis 8, legs 9-10 and 11-12 (knee, ankle).
//
// Lengths are fractions of the stature and segments' masses fractions of the body's (winter2009 chapter 4:
// figure 4.1, table 4.1). The mass of a segment is put at its two ends such that the centre of mass is where
// the table has it; hands and feet are at wrists and ankles, the head at its own centre.
#include <array>

#include <pfaff/systems/bead_rod/system.hpp>

namespace {
using namespace pfaff;

struct Humanoid : BeadRods<Humanoid> {
  int seed = 0;
  Real mass = 75, stature = 1.75_r, drag = 0.5_r, gravity = 9.81_r;
  static std::vector<Parameter> parameters() {
    return {
        parameter(&Humanoid::mass, "mass", "kg", 1, 1e3, "of the body"),
        parameter(&Humanoid::stature, "stature", "m", 0.1, 10),
        parameter(&Humanoid::drag, "friction", "kg/s", 0, 1e3, "of each point"),
        parameter(&Humanoid::gravity, "gravity", "m/s^2", -1e3, 1e3),
        parameter(&Humanoid::seed, "seed", "", 0, 1000000000, "of the velocities at the start; 0: at rest")};
  }
  [[nodiscard]] BeadRodDescription describe() const {
    BeadRodDescription d;
    d.origin = "system humanoid";
    d.dimension = 3;
    d.masses.assign(13, 0);
    d.positions.assign(39, 0);
    // Masses: segment from `near` to `far`, its share of the body, the centre of mass as a fraction from
    // near.
    const auto segment = [&](std::size_t near, std::size_t far, const Real& share, const Real& centre) {
      d.masses[near] = d.masses[near] + mass * (share * (1 - centre));
      d.masses[far] = d.masses[far] + mass * (share * centre);
    };
    segment(0, 0, 0.081_r, 1);      // head and neck
    segment(1, 8, 0.497_r, 0.5_r);  // trunk
    for (const std::size_t shoulder : {2U, 5U}) {
      segment(shoulder, shoulder + 1, 0.028_r, 0.436_r);      // upper arm
      segment(shoulder + 1, shoulder + 2, 0.016_r, 0.430_r);  // forearm
      segment(shoulder + 2, shoulder + 2, 0.006_r, 1);        // hand
    }
    for (const std::size_t knee : {9U, 11U}) {
      segment(8, knee, 0.1_r, 0.433_r);            // thigh
      segment(knee, knee + 1, 0.0465_r, 0.433_r);  // leg
      segment(knee + 1, knee + 1, 0.0145_r, 1);    // foot
    }
    // Rods: length as a fraction of the stature, and the direction of the second point from the first.
    const auto rod = [&](std::size_t a, std::size_t b, const Real& fraction,
                         const std::array<Real, 3>& direction) {
      d.rods.push_back({a, b, fraction * stature});
      for (std::size_t x = 0; x < 3; ++x)
        d.positions[3 * b + x] = d.positions[3 * a + x] + d.rods.back().length * direction[x];
    };
    const Real three = Real::fraction(3, 5), four = Real::fraction(4, 5);
    d.positions[2] = 0.936_r * stature;  // eye level
    rod(0, 1, 0.118_r, {0, 0, -1});      // down to the level of the shoulders, 0.818
    rod(1, 2, 0.129_r, {0, 1, 0});
    rod(2, 3, 0.186_r, {0, three, -four});
    rod(3, 4, 0.146_r, {three, 0, -four});
    rod(1, 5, 0.129_r, {0, -1, 0});
    rod(5, 6, 0.186_r, {0, -three, -four});
    rod(6, 7, 0.146_r, {three, 0, -four});
    rod(1, 8, 0.288_r, {0, 0, -1});  // to the level of the hips, 0.530
    rod(8, 9, 0.245_r, {three, 0, -four});
    rod(9, 10, 0.246_r, {-three, 0, -four});
    rod(8, 11, 0.245_r, {0, -three, -four});
    rod(11, 12, 0.246_r, {0, 0, -1});
    if (!drag.is(0)) d.friction.assign(13, drag);
    d.gravity = {0, 0, -gravity};
    d.momenta.assign(39, 0);
    if (seed != 0) start_at_random(d, seed);
    return d;
  }
};

const System<Humanoid> registered{
    {.name = "humanoid",
     .title = "a human figure of 13 points and 12 rods, falling",
     .reference = "nguyen-turski section 4; winter2009",
     .description = "A human figure of 13 points and 12 rods that falls, with lengths and masses after "
                    "tables of anthropometry. Take it as a branched graph of rods, where S is solved along "
                    "the tree. It has no joints' limits, no muscles and no ground: it is a test of "
                    "constraints and not a model of walking."}};
}  // namespace
