// Projected methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/constrained/projection.hpp>
#include <pfaff/integrators/runge_kutta/explicit_runge_kutta.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>

namespace {
using namespace pfaff;

struct ProjectedRungeKutta4 : Projected<RungeKutta4, SurfaceShift> {};
struct ProjectedGauss : SymmetricallyProjected<Gauss, SurfaceShift> {
  /// Every iteration solves for all stages, which is slow: a quick check takes one order only.
  static std::vector<Assignments> instances(bool full) {
    if (!full) return {{{"stages", "2"}}};
    return {{{"stages", "1"}}, {{"stages", "2"}}, {{"stages", "3"}}};
  }
};

const Method<ProjectedRungeKutta4> projected_runge_kutta{
    {.name = "projected-rk4",
     .title = "classical Runge-Kutta method, each step projected onto the constraints",
     .family = "constrained",
     .reference = "hairer-lubich-wanner2006 IV.4; hairer-norsett-wanner1993 II.1",
     .description =
         "A step of the classical Runge-Kutta method followed by projection onto both levels of the "
         "constraints, of order 4. Take it where constraints have to hold but nothing else is asked for, "
         "with friction too. The projection keeps no other structure: energies drift as without it.",
     .order = 4,
     .preserves = {Claim::constraints}}};
const Method<ProjectedGauss> projected_gauss{
    {.name = "projected-gauss",
     .title = "Gauss collocation projected symmetrically onto the constraints, order 2 s",
     .family = "constrained",
     .reference = "hairer-lubich-wanner2006 V.4.1, (II.1.3)",
     .description = "Gauss collocation with a symmetric projection, which leaves and enters the constraint "
                    "surface by the same multipliers, of order 2 s. Take it for long runs of time-reversible "
                    "systems, where energies do not drift although it is not symplectic. Each step solves "
                    "for stages and multipliers together, which costs more than RATTLE does.",
     .preserves = {Claim::symmetric, Claim::constraints}}};
}  // namespace
