// A chain of damped oscillators, r_i'' + nu r_i' + r_i + kappa (2 r_i - r_{i-1} - r_{i+1}) = 0 with free
// ends, in Birkhoff's form: damped_chain.hpp with w = r^2/2. B is conserved, as it is for each mode.
#include <pfaff/core/system.hpp>

#include "damped_chain.hpp"

namespace {
using namespace pfaff;

struct OscillatorSpring {
  static constexpr const char* unit = "m";
  template <class T>
  static T energy(const T& r) {
    return r * r / 2;
  }
  template <class T>
  static T force(const T& r) {
    return -r;
  }
};

struct CoupledDampedOscillators : DampedChain<CoupledDampedOscillators, OscillatorSpring> {
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = birkhoffian(t, z);
    values[1] = square_of_momenta<T>(z) / 2 + potential_energy<T>(z);
  }
};

const System<CoupledDampedOscillators> registered{
    {.name = "coupled-damped-oscillators",
     .title = "chain of damped oscillators, r_i'' + nu r_i' + r_i + springs = 0",
     .reference = "su-qin (92)-(95); landau-lifshitz1976 sections 23, 25",
     .description = "A chain of damped linear oscillators with springs between neighbours, of any length. "
                    "Take it to see how methods in Darboux coordinates scale with the number of degrees of "
                    "freedom, with a conserved Birkhoffian to check against. It is linear and falls into "
                    "modes, and hides errors of order.",
     .invariants = {conserved("birkhoffian", "m^2/s^2"), decreasing("energy", "m^2/s^2")}}};
}  // namespace
