// Other treatments of constraints in the Stoermer-Verlet method, as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/constrained/lincs.hpp>
#include <pfaff/integrators/constrained/shake.hpp>

namespace {
using namespace pfaff;

const Method<Shake> shake{
    {.name = "shake",
     .title = "SHAKE: positions on the constraints, momenta of central differences",
     .family = "constrained",
     .reference = "ryckaert1977; hairer-lubich-wanner2006 VII.1.4",
     .description =
         "Stoermer-Verlet with positions kept on the constraints and momenta from central differences, as in "
         "the first codes of molecular dynamics. Take it to compare with those; its positions are those of "
         "RATTLE. Its momenta do not satisfy the hidden constraints, and it claims nothing for them.",
     .order = 2,
     .preserves = {Claim::none}}};
const Method<Lincs> lincs{
    {.name = "lincs",
     .title = "Stoermer-Verlet with LINCS: constraint forces from a truncated series",
     .family = "constrained",
     .reference = "hess1997",
     .description = "Stoermer-Verlet with constraint forces from a truncated series and a few corrections "
                    "instead of a solve. Take it to see what such approximations cost and leave behind. The "
                    "constraints hold as far as the series converges, which it does for chains and slowly or "
                    "not at all for rods that share beads in triangles.",
     .preserves = {Claim::none}}};
}  // namespace
