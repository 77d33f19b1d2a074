// RATTLE as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/constrained/rattle.hpp>

namespace {
using namespace pfaff;

struct Rattle : pfaff::Rattle {
  using Composed = Composition<pfaff::Rattle>;
};

const Method<Rattle> rattle{
    {.name = "rattle",
     .title = "RATTLE: Stoermer-Verlet on the constraint surface",
     .family = "constrained",
     .reference = "andersen1983; hairer-lubich-wanner2006 VII.1.4",
     .description =
         "Stoermer-Verlet on the surface of holonomic constraints, symmetric and of order 2. Take it first "
         "for constrained systems with separable energies: it is symplectic on the surface, keeps both "
         "levels of constraints and momentum maps to round-off, and costs one force and one factorisation a "
         "step. It has no place for friction or for mass matrices that depend on the positions.",
     .order = 2,
     .preserves = {Claim::constrained_symplectic, Claim::symmetric, Claim::constraints,
                   Claim::momentum_maps}}};
}  // namespace
