// The Lobatto IIIA-IIIB pair on the constraint surface as a plug-in.
#include <pfaff/integrators/lobatto_spark.hpp>

#include <pfaff/core/integrator.hpp>

namespace {
using namespace pfaff;

struct LobattoSpark : pfaff::LobattoSpark {};

const Method<LobattoSpark> registered{
    {.name = "lobatto-spark",
     .title = "Lobatto IIIA-IIIB pair on the constraint surface, order 2 s - 2",
     .reference = "jay1996; hairer-lubich-wanner2006 VII.1.5",
     .preserves = {Claim::constrained_symplectic, Claim::symmetric, Claim::constraints,
                   Claim::momentum_maps}}};
}  // namespace
