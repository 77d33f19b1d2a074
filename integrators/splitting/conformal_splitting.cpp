// Conformal splitting as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/splitting/conformal_splitting.hpp>

namespace {
using namespace pfaff;

struct ConformalSplitting : pfaff::ConformalSplitting {
  using Composed = Composition<pfaff::ConformalSplitting>;
};

const Method<ConformalSplitting> strang{
    {.name = "conformal-splitting",
     .title = "Strang splitting into friction and Stoermer-Verlet",
     .family = "splitting",
     .reference = "bhatt2016; mclachlan-perlmutter2001",
     .description = "Stoermer-Verlet between two half steps of the exact flow of linear friction: explicit, "
                    "symmetric and of order 2. Take it for separable energies with a friction proportional "
                    "to the momenta, where it keeps the decaying canonical structure exactly. Friction that "
                    "depends on the state or differs between degrees of freedom is outside its reach.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::k_symplectic, Claim::conformal}}};
}  // namespace
