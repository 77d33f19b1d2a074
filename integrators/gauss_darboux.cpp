// Gauss collocation in Darboux coordinates as a plug-in.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/gauss.hpp>
#include <pfaff/integrators/in_chart.hpp>

namespace {
using namespace pfaff;

struct GaussDarboux : InDarbouxChart<Gauss> {};

const Method<GaussDarboux> registered{
    {.name = "gauss-darboux",
     .title = "Gauss collocation in Darboux coordinates, order 2 s",
     .reference = "hairer-lubich-wanner2006 (II.1.3), VI.4.2; su-qin (21)",
     .preserves = {Claim::symmetric, Claim::symplectic, Claim::k_symplectic}}};
}  // namespace
