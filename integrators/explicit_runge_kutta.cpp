// The explicit Runge-Kutta methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/explicit_runge_kutta.hpp>

namespace {
using namespace pfaff;

struct RungeKutta4 : pfaff::RungeKutta4 {};

const Method<RungeKutta4> registered{{.name = "rk4",
                                      .title = "classical Runge-Kutta method of order 4",
                                      .reference = "hairer-norsett-wanner1993 II.1",
                                      .order = 4,
                                      .preserves = {Claim::none}}};
}  // namespace
