// Conformal splitting as a plug-in, and its compositions.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/composition.hpp>
#include <pfaff/integrators/conformal_splitting.hpp>

namespace {
using namespace pfaff;

struct ConformalSplitting : pfaff::ConformalSplitting {};

using Splittings = Composition<pfaff::ConformalSplitting>;
struct SuzukiConformal : Composed<SuzukiFamily, Splittings> {};
struct KahanLiConformal : Composed<KahanLiFamily, Splittings> {};

const Method<ConformalSplitting> strang{{.name = "conformal-splitting",
                                         .title = "Strang splitting into friction and Stoermer-Verlet",
                                         .reference = "bhatt2016; mclachlan-perlmutter2001",
                                         .order = 2,
                                         .preserves = {Claim::symmetric, Claim::k_symplectic}}};
const Method<SuzukiConformal> suzuki{{.name = "suzuki-conformal",
                                      .title = "fivefold jumps of conformal splitting",
                                      .reference = "suzuki1990; bhatt2016",
                                      .preserves = {Claim::symmetric, Claim::k_symplectic}}};
const Method<KahanLiConformal> kahan_li{{.name = "kahan-li-conformal",
                                         .title = "Kahan and Li's compositions of conformal splitting",
                                         .reference = "kahan-li1997; bhatt2016",
                                         .preserves = {Claim::symmetric, Claim::k_symplectic}}};
}  // namespace
