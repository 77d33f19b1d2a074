// The splitting methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/splitting.hpp>

namespace {
using namespace pfaff;

struct Verlet : pfaff::Verlet {};
struct SymplecticEuler : pfaff::SymplecticEuler {};

const Method<Verlet> verlet{{.name = "verlet",
                             .title = "Stoermer-Verlet, position form",
                             .reference = "hairer-lubich-wanner2006 (I.1.17)",
                             .order = 2,
                             .preserves = {Claim::symplectic, Claim::symmetric}}};
const Method<SymplecticEuler> symplectic_euler{{.name = "symplectic-euler",
                                                .title = "symplectic Euler: kick, then drift",
                                                .reference = "hairer-lubich-wanner2006 (I.1.9)",
                                                .order = 1,
                                                .preserves = {Claim::symplectic}}};
}  // namespace
