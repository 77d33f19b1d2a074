// The Kepler problem as a plug-in.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/kepler.hpp>

namespace {
using namespace pfaff;

struct Kepler : pfaff::Kepler {};

const System<Kepler> registered{
    {.name = "kepler",
     .title = "planar Kepler problem, H = |p|^2/2 - 1/|q|",
     .reference = "hairer-lubich-wanner2006 I.2.2",
     .coordinates = {{"q1", ""}, {"q2", ""}, {"p1", ""}, {"p2", ""}},
     .invariants = {conserved("energy", ""), conserved_quadratic("angular-momentum", ""),
                    conserved("lenz-1", ""), conserved("lenz-2", "")},
     .time_unit = ""}};
}  // namespace
