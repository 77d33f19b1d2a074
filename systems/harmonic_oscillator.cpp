// The harmonic oscillator as a plug-in.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/harmonic_oscillator.hpp>

namespace {
using namespace pfaff;

struct HarmonicOscillator : pfaff::HarmonicOscillator {};

const System<HarmonicOscillator> registered{{.name = "harmonic-oscillator",
                                             .title = "harmonic oscillator, q'' + omega^2 q = 0",
                                             .reference = "hairer-lubich-wanner2006 I.1",
                                             .coordinates = {{"q", "m"}, {"p", "m/s"}},
                                             .initial = {1, 0},
                                             .invariants = {conserved_quadratic("energy", "m^2/s^2")}}};
}  // namespace
