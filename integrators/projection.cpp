// Projected methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/explicit_runge_kutta.hpp>
#include <pfaff/integrators/gauss.hpp>
#include <pfaff/integrators/projection.hpp>

namespace {
using namespace pfaff;

struct ProjectedRungeKutta4 : Projected<RungeKutta4> {};
struct ProjectedGauss : SymmetricallyProjected<Gauss> {
  /// Each iteration solves for all stages: one order in a quick check.
  static std::vector<Assignments> instances(bool full) {
    if (!full) return {{{"stages", "2"}}};
    return {{{"stages", "1"}}, {{"stages", "2"}}, {{"stages", "3"}}};
  }
};

const Method<ProjectedRungeKutta4> projected{
    {.name = "projected-rk4",
     .title = "classical Runge-Kutta method, each step projected onto the constraints",
     .reference = "hairer-lubich-wanner2006 IV.4; hairer-norsett-wanner1993 II.1",
     .order = 4,
     .preserves = {Claim::constraints}}};
const Method<ProjectedGauss> symmetric{
    {.name = "projected-gauss",
     .title = "Gauss collocation projected symmetrically onto the constraints, order 2 s",
     .reference = "hairer-lubich-wanner2006 V.4.1, (II.1.3)",
     .preserves = {Claim::symmetric, Claim::constraints}}};
}  // namespace
