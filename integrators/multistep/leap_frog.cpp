// The leap-frog scheme as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/multistep/leap_frog.hpp>

namespace {
using namespace pfaff;

struct LeapFrog : pfaff::LeapFrog {
  static constexpr bool fixed_sizes = false;  // one field evaluation and two sums
};

const Method<LeapFrog> registered{
    {.name = "leap-frog",
     .title = "leap-frog scheme (explicit two-step midpoint rule)",
     .reference = "hairer-norsett-wanner1993 III.1",
     .description = "The explicit two-step midpoint rule for any vector field, of order 2 with one "
                    "evaluation a step. Take it only to compare, as one of the conventional schemes that "
                    "keep no Birkhoffian structure. It is weakly stable: where the motion decays a parasitic "
                    "oscillation between odd and even steps grows.",
     .order = 2,
     .preserves = {Claim::none}}};
}  // namespace
