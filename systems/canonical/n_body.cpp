// The system of n bodies as a plug-in.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/n_body.hpp>

namespace {
using namespace pfaff;

const System<NBody> registered{
    {.name = "n-body",
     .title = "n bodies that attract each other, H = sum |p_i|^2/(2 m_i) - G sum m_i m_j/r_ij",
     .reference = "aarseth1963",
     .description =
         "Any number of bodies of total mass one under their attraction, in a plane or in space, with "
         "softened distances where wanted: all equal, or about a heavier first one (central). Take it to see "
         "how methods and costs grow with the number of "
         "bodies: an evaluation takes n (n - 1)/2 square roots. Without softening, "
         "random starts lead to close encounters, which steps of one size do not resolve.",
     .time_unit = ""}};
}  // namespace
