// Gauss collocation in Darboux coordinates, and the midpoint rule among it, as plug-ins. The midpoint rule in
// the chart is the generating-function scheme of order 2 expanded at the middle of the step.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/runge_kutta/gauss.hpp>
#include <pfaff/integrators/support/in_chart.hpp>

namespace {
using namespace pfaff;

struct GaussDarboux : InDarbouxChart<Gauss> {};
struct MidpointDarboux : InDarbouxChart<ImplicitMidpoint> {
  using Composed = ProcessedInDarbouxChart<Composition<ImplicitMidpoint>>;  // sub-steps stay in the chart
};

const Method<GaussDarboux> gauss_darboux{
    {.name = "gauss-darboux",
     .title = "Gauss collocation in Darboux coordinates, order 2 s",
     .family = "darboux",
     .reference = "hairer-lubich-wanner2006 (II.1.3), VI.4.2; su-qin (21)",
     .description = "Gauss collocation in the Darboux coordinates of a system, of order 2 s and exactly K(z, "
                    "t)-symplectic. Take it where a chart is at hand and high accuracy is asked for, beside "
                    "the generating functions of the same chart. It needs the chart and its inverse at every "
                    "step, and loses digits where the chart mixes numbers of very different size.",
     .preserves = {Claim::symmetric, Claim::reversible, Claim::symplectic, Claim::k_symplectic}}};
const Method<MidpointDarboux> midpoint_darboux{
    {.name = "midpoint-darboux",
     .title = "implicit midpoint rule in Darboux coordinates",
     .family = "darboux",
     .reference = "hairer-lubich-wanner2006 (II.1.4); su-qin (21)",
     .description =
         "The implicit midpoint rule in the Darboux coordinates of a system, of order 2 and exactly "
         "K(z, t)-symplectic. Take it as the base of compositions, which raise its order and stay "
         "in the chart between sub-steps. By itself it is gauss-darboux of one stage.",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::reversible, Claim::symplectic, Claim::k_symplectic}}};
}  // namespace
