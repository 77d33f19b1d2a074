// The generating-function schemes as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/generating/generating_function.hpp>

namespace {
using namespace pfaff;

struct GeneratingFunction : pfaff::GeneratingFunction {};

const Method<GeneratingFunction> registered{
    {.name = "generating-function",
     .title = "K(z,t)-symplectic generating-function scheme of order m",
     .reference = "su-qin (87)-(88)",
     .description =
         "Schemes of any order m from the truncated generating function of a Darboux chart, su-qin "
         "(87)-(88). Take them for damped and other Birkhoffian systems with a chart: the time-dependent "
         "structure is kept exactly at every step size, and high orders come at moderate extra cost. They "
         "need the chart and series of the field in it, and an implicit solve at each step."}};
}  // namespace
