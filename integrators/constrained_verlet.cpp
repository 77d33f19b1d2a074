// Other treatments of constraints in the Stoermer-Verlet method, as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/lincs.hpp>
#include <pfaff/integrators/shake.hpp>

namespace {
using namespace pfaff;

struct Shake : pfaff::Shake {};
struct Lincs : pfaff::Lincs {};

const Method<Shake> shake{{.name = "shake",
                           .title = "SHAKE: positions on the constraints, momenta of central differences",
                           .reference = "ryckaert1977; hairer-lubich-wanner2006 VII.1.4",
                           .order = 2,
                           .preserves = {Claim::none}}};
const Method<Lincs> lincs{{.name = "lincs",
                           .title = "Stoermer-Verlet with LINCS: constraint forces from a truncated series",
                           .reference = "hess1997",
                           .order = 2,
                           .preserves = {Claim::none}}};
}  // namespace
