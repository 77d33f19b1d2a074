// Methods projected onto velocity constraints as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/nonholonomic/velocity_projection.hpp>
#include <pfaff/integrators/runge_kutta/explicit_runge_kutta.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>

namespace {
using namespace pfaff;

struct VelocityProjectedRungeKutta4 : Projected<RungeKutta4, VelocityShift> {};
struct VelocityProjectedGauss : SymmetricallyProjected<Gauss, VelocityShift> {
  /// Every iteration solves for all stages, which is slow: a quick check takes one order only.
  static std::vector<Assignments> instances(bool full) {
    if (!full) return {{{"stages", "2"}}};
    return {{{"stages", "1"}}, {{"stages", "2"}}, {{"stages", "3"}}};
  }
};

const Method<VelocityProjectedRungeKutta4> velocity_projected_runge_kutta{
    {.name = "velocity-projected-rk4",
     .title = "classical Runge-Kutta method, momenta projected onto velocity constraints",
     .family = "nonholonomic",
     .reference = "hairer-lubich-wanner2006 IV.4; hairer-norsett-wanner1993 II.1",
     .description =
         "A step of the classical Runge-Kutta method in a formulation, nonholonomic by default, followed by "
         "projection of the momenta onto the velocity constraints, of order 4. Take it where constraints "
         "have "
         "to hold but nothing else is asked for. It keeps no other structure: energies drift.",
     .order = 4,
     .preserves = {Claim::velocity_constraints}}};
const Method<VelocityProjectedGauss> velocity_projected_gauss{
    {.name = "velocity-projected-gauss",
     .title = "Gauss collocation, momenta projected symmetrically onto velocity constraints, order 2 s",
     .family = "nonholonomic",
     .reference = "hairer-lubich-wanner2006 V.4.1, (II.1.3)",
     .description =
         "Gauss collocation in a formulation, nonholonomic by default, with a symmetric projection of the "
         "momenta onto the velocity constraints, of order 2 s. Take it for long runs of reversible systems "
         "at "
         "high accuracy. Each step solves for stages and multipliers together, which costs much more than a "
         "step of `dla`.",
     .preserves = {Claim::symmetric, Claim::reversible, Claim::velocity_constraints}}};
}  // namespace
