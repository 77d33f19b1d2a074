// A chain of damped pendula, r_i'' + nu r_i' + sin r_i + kappa (2 r_i - r_{i-1} - r_{i+1}) = 0 with free
// ends, in Birkhoff's form: damped_chain.hpp with w = -cos r. It is the damped sine-Gordon equation on a
// lattice.
#include <pfaff/core/system.hpp>

#include "damped_chain.hpp"

namespace {
using namespace pfaff;

struct PendulumSpring {
  static constexpr const char* unit = "rad";
  template <class T>
  static T energy(const T& r) {
    return -cos(r);
  }
  template <class T>
  static T force(const T& r) {
    return -sin(r);
  }
};

struct CoupledDampedPendula : DampedChain<CoupledDampedPendula, PendulumSpring> {
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = square_of_momenta<T>(z) / 2 + potential_energy<T>(z);
  }
};

const System<CoupledDampedPendula> registered{
    {.name = "coupled-damped-pendula",
     .title = "chain of damped pendula, r_i'' + nu r_i' + sin r_i + springs = 0",
     .reference = "su-qin (92)-(95); landau-lifshitz1976 sections 23, 25",
     .description = "A chain of damped pendula with springs between neighbours, the damped sine-Gordon "
                    "equation on a lattice. Take it as the nonlinear problem of many degrees of freedom for "
                    "methods that keep a time-dependent structure. Each evaluation costs a number of "
                    "operations linear in the length; only the decay of the energy is known beforehand.",
     .invariants = {decreasing("energy", "rad^2/s^2")}}};
}  // namespace
