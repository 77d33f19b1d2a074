// The Lobatto IIIA-IIIB pair on the constraint surface as a plug-in.
#include <pfaff/integrators/constrained/lobatto_spark.hpp>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

const Method<LobattoSpark> registered{
    {.name = "lobatto-spark",
     .title = "Lobatto IIIA-IIIB pair on the constraint surface, order 2 s - 2",
     .family = "constrained",
     .reference = "jay1996; hairer-lubich-wanner2006 VII.1.5",
     .description = "The Lobatto IIIA-IIIB pair on the surface of holonomic constraints, of order 2 s - 2. "
                    "Take it for high accuracy on the surface, and where the mass matrix depends on the "
                    "positions, which RATTLE excludes; with two stages and a separable energy it is RATTLE. "
                    "It is implicit in all its stages, and has no place for friction.",
     .preserves = {Claim::constrained_symplectic, Claim::symmetric, Claim::constraints,
                   Claim::momentum_maps}}};
}  // namespace
