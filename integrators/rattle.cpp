// RATTLE and its compositions as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/composition.hpp>
#include <pfaff/integrators/rattle.hpp>

namespace {
using namespace pfaff;

struct Rattle : pfaff::Rattle {};
using Rattles = Composition<pfaff::Rattle>;
struct YoshidaRattle : Composed<YoshidaFamily, Rattles> {};
struct SuzukiRattle : Composed<SuzukiFamily, Rattles> {};
struct KahanLiRattle : Composed<KahanLiFamily, Rattles> {};

const std::vector<Claim> kept{Claim::constrained_symplectic, Claim::symmetric, Claim::constraints,
                              Claim::momentum_maps};

const Method<Rattle> rattle{{.name = "rattle",
                             .title = "RATTLE: Stoermer-Verlet on the constraint surface",
                             .reference = "andersen1983; hairer-lubich-wanner2006 VII.1.4",
                             .order = 2,
                             .preserves = kept}};
const Method<YoshidaRattle> yoshida{{.name = "yoshida-rattle",
                                     .title = "triple jumps of RATTLE",
                                     .reference = "yoshida1990; hairer-lubich-wanner2006 (II.4.4), VII.1.4",
                                     .preserves = kept}};
const Method<SuzukiRattle> suzuki{{.name = "suzuki-rattle",
                                   .title = "fivefold jumps of RATTLE",
                                   .reference = "suzuki1990; hairer-lubich-wanner2006 (II.4.5), VII.1.4",
                                   .preserves = kept}};
const Method<KahanLiRattle> kahan_li{
    {.name = "kahan-li-rattle",
     .title = "Kahan and Li's compositions of RATTLE",
     .reference = "kahan-li1997; hairer-lubich-wanner2006 (V.3.11), (V.3.13), VII.1.4",
     .preserves = kept}};
}  // namespace
