// The Gauss methods as plug-ins.
#include <pfaff/core/integrator.hpp>
#include <pfaff/integrators/gauss.hpp>

namespace {
using namespace pfaff;

struct Gauss : pfaff::Gauss {};
struct ImplicitMidpoint : pfaff::ImplicitMidpoint {};

const Method<Gauss> gauss{{.name = "gauss",
                           .title = "Gauss collocation, order 2 s",
                           .reference = "hairer-lubich-wanner2006 (II.1.3)",
                           .preserves = {Claim::symmetric, Claim::symplectic, Claim::quadratic_invariants}}};
const Method<ImplicitMidpoint> midpoint{
    {.name = "implicit-midpoint",
     .title = "implicit midpoint rule (Euler centre scheme)",
     .reference = "su-qin (107); hairer-lubich-wanner2006 (II.1.4)",
     .order = 2,
     .preserves = {Claim::symmetric, Claim::symplectic, Claim::quadratic_invariants}}};
}  // namespace
