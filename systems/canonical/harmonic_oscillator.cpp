// The harmonic oscillator as a plug-in.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/harmonic_oscillator.hpp>

namespace {
using namespace pfaff;

const System<HarmonicOscillator> registered{
    {.name = "harmonic-oscillator",
     .title = "harmonic oscillator, q'' + omega^2 q = 0",
     .reference = "hairer-lubich-wanner2006 I.1",
     .description = "The linear oscillator of unit mass, whose exact solution is known. Take it to see phase "
                    "and amplitude errors and for stability limits, as every method can be solved on it by "
                    "hand. It is linear: it hides errors of order that nonlinear systems show, and "
                    "symplectic methods look better on it than they are.",
     .coordinates = {{"q", "m"}, {"p", "m/s"}},
     .initial = {1, 0},
     .invariants = {conserved_quadratic("energy", "m^2/s^2")}}};
}  // namespace
