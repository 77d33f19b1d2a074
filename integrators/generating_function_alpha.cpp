// The generating-function schemes of a user's alpha as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/generating_function_alpha.hpp>

namespace {
using namespace pfaff;

struct GeneratingFunctionAlpha : pfaff::GeneratingFunctionAlpha {};

const Method<GeneratingFunctionAlpha> registered{
    {.name = "generating-function-alpha",
     .title = "K(z,t)-symplectic generating-function scheme of order m for the system's own alpha",
     .reference = "su-qin (32)-(34), (87)-(88)"}};
}  // namespace
