// The generating-function schemes as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/generating_function.hpp>

namespace {
using namespace pfaff;

struct GeneratingFunction : pfaff::GeneratingFunction {};

const Method<GeneratingFunction> registered{
    {.name = "generating-function",
     .title = "K(z,t)-symplectic generating-function scheme of order m",
     .reference = "su-qin (87)-(88)"}};
}  // namespace
