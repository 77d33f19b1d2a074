// The leap-frog scheme as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/leap_frog.hpp>

namespace {
using namespace pfaff;

struct LeapFrog : pfaff::LeapFrog {
  static constexpr bool fixed_sizes = false;  // one field evaluation and two sums
};

const Method<LeapFrog> registered{{.name = "leap-frog",
                                   .title = "leap-frog scheme (explicit two-step midpoint rule)",
                                   .reference = "hairer-norsett-wanner1993 III.1",
                                   .order = 2,
                                   .preserves = {Claim::none}}};
}  // namespace
