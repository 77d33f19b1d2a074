// Compositions of the Stoermer-Verlet method as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/composition.hpp>
#include <pfaff/integrators/splitting.hpp>

namespace {
using namespace pfaff;

using Verlets = Composition<Verlet>;
struct YoshidaVerlet : Composed<YoshidaFamily, Verlets> {};
struct SuzukiVerlet : Composed<SuzukiFamily, Verlets> {};
struct KahanLiVerlet : Composed<KahanLiFamily, Verlets> {};

const Method<YoshidaVerlet> yoshida{{.name = "yoshida-verlet",
                                     .title = "triple jumps of the Stoermer-Verlet method",
                                     .reference = "yoshida1990; hairer-lubich-wanner2006 (II.4.4)",
                                     .preserves = {Claim::symplectic, Claim::symmetric}}};
const Method<SuzukiVerlet> suzuki{{.name = "suzuki-verlet",
                                   .title = "fivefold jumps of the Stoermer-Verlet method",
                                   .reference = "suzuki1990; hairer-lubich-wanner2006 (II.4.5)",
                                   .preserves = {Claim::symplectic, Claim::symmetric}}};
const Method<KahanLiVerlet> kahan_li{
    {.name = "kahan-li-verlet",
     .title = "Kahan and Li's compositions of the Stoermer-Verlet method",
     .reference = "kahan-li1997; hairer-lubich-wanner2006 (V.3.11), (V.3.13)",
     .preserves = {Claim::symplectic, Claim::symmetric}}};
}  // namespace
