// The generating-function schemes of a user's alpha as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/generating/generating_function_alpha.hpp>

namespace {
using namespace pfaff;

const Method<GeneratingFunctionAlpha> registered{
    {.name = "generating-function-alpha",
     .title = "K(z,t)-symplectic generating-function scheme of order m for the system's own alpha",
     .family = "generating",
     .reference = "su-qin (32)-(34), (87)-(88)",
     .description = "Schemes of any order m from the truncated generating function of a system's own "
                    "transformation alpha of pairs of states. Take them where no Darboux chart is known: the "
                    "structure is kept exactly in the system's own coordinates. Where there is a chart, "
                    "generating-function is faster and sums its updates with compensation."}};
}  // namespace
