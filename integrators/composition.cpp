// Compositions of the midpoint rule in Darboux coordinates as plug-ins. That rule is the generating-function
// scheme of order 2 expanded at the middle of the step.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/composition.hpp>
#include <pfaff/integrators/gauss.hpp>
#include <pfaff/integrators/in_chart.hpp>

namespace {
using namespace pfaff;

using Midpoints = InDarbouxChart<Composition<ImplicitMidpoint>>;
struct Yoshida : Composed<YoshidaFamily, Midpoints> {};
struct Suzuki : Composed<SuzukiFamily, Midpoints> {};
struct KahanLi : Composed<KahanLiFamily, Midpoints> {};

const Method<Yoshida> yoshida{{.name = "yoshida",
                               .title = "triple jumps of the midpoint rule in Darboux coordinates",
                               .reference = "yoshida1990; hairer-lubich-wanner2006 (II.4.4)",
                               .preserves = {Claim::symmetric, Claim::symplectic, Claim::k_symplectic}}};
const Method<Suzuki> suzuki{{.name = "suzuki",
                             .title = "fivefold jumps of the midpoint rule in Darboux coordinates",
                             .reference = "suzuki1990; hairer-lubich-wanner2006 (II.4.5)",
                             .preserves = {Claim::symmetric, Claim::symplectic, Claim::k_symplectic}}};
const Method<KahanLi> kahan_li{
    {.name = "kahan-li",
     .title = "Kahan and Li's compositions of the midpoint rule in Darboux coordinates",
     .reference = "kahan-li1997; hairer-lubich-wanner2006 (V.3.11), (V.3.13)",
     .preserves = {Claim::symmetric, Claim::symplectic, Claim::k_symplectic}}};
}  // namespace
