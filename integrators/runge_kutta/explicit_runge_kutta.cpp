// The explicit Runge-Kutta methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/runge_kutta/explicit_runge_kutta.hpp>

namespace {
using namespace pfaff;

struct RungeKutta4 : pfaff::RungeKutta4 {};

const Method<RungeKutta4> registered{
    {.name = "rk4",
     .title = "classical Runge-Kutta method of order 4",
     .reference = "hairer-norsett-wanner1993 II.1",
     .description =
         "The classical explicit Runge-Kutta method of order 4. Take it as the yardstick, and for short runs "
         "at moderate accuracy of any vector field. It keeps no structure: energies drift linearly over long "
         "runs, and here it is the control that every test of structure has to reject.",
     .order = 4,
     .preserves = {Claim::none}}};
}  // namespace
