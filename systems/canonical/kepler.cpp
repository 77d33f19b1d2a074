// The Kepler problem as a plug-in.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/kepler.hpp>

namespace {
using namespace pfaff;

const System<Kepler> registered{
    {.name = "kepler",
     .title = "planar Kepler problem, H = |p|^2/2 - 1/|q|",
     .reference = "hairer-lubich-wanner2006 I.2.2",
     .description = "One body about a fixed centre in the plane, on an ellipse of unit semi-major axis and a "
                    "chosen eccentricity, started at the pericentre. Take it to compare the drift of energy, "
                    "angular momentum and the Lenz vector over many revolutions of period 2 pi. Steps of one "
                    "size suit small eccentricities: near 1 the passage of the pericentre asks for steps far "
                    "smaller than the rest of the orbit does.",
     .coordinates = {{"q1", ""}, {"q2", ""}, {"p1", ""}, {"p2", ""}},
     .invariants = {conserved("energy", ""), conserved_quadratic("angular-momentum", ""),
                    conserved("lenz-1", ""), conserved("lenz-2", "")},
     .time_unit = ""}};
}  // namespace
