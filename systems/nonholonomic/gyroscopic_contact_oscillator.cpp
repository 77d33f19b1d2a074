// A relative of the contact oscillator that no map of its states reverses: a gyroscopic force with the vector
// potential a = (0, -gamma x z, 0), and a bent distribution.
//
//   H = (|p - a|^2 + |q|^2 + epsilon x^2 z^2)/2,   x' + (y - beta x z) z' = 0,   v = p - a
//
// A term of the energy that is linear in the velocities breaks (q, v) -> (q, -v), but that is not enough: a
// mirror may survive, as it does for a constant gyroscopic force (y' z' - z' y') and the mirror (x, y, z) ->
// (-x, y, -z). And a gauge term leaves the motion as it is (contact-oscillator-conjugate). Here nothing
// survives: the equilibria are the line q = (s, 0, 0), v = 0, since V_q = lambda A asks for y = 0 and z (1 +
// (epsilon + beta (1 + epsilon z^2)) x^2) = 0. The motion near one is
//   y'' = -y + gamma s z',   z'' = -(1 + (epsilon + beta) s^2) z + s y - gamma s y',
// with the characteristic polynomial l^4 + c_2 l^2 - gamma s^2 l + c_0. A reversal, any smooth invertible map
// rho with rho o flow_t = flow_-t o rho, would map equilibria to equilibria and change the sign of their
// exponents, and so of gamma s^2. But that has one sign on all of them.
//
// gamma makes the difference: with gamma = 0 the distribution is as bent as before, and the motion is
// reversible.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/nonholonomic/contact_oscillator.hpp>

namespace {
using namespace pfaff;

struct GyroscopicContactOscillator : ContactOscillator {
  Real beta = 1, gamma = 1;
  static std::vector<Parameter> parameters() {
    using S = GyroscopicContactOscillator;
    return {
        parameter(static_cast<Real S::*>(&S::epsilon), "epsilon", "1/m^2", 0, 1e3, "of epsilon x^2 z^2/2"),
        parameter(&S::beta, "beta", "1/m", 0, 1e3, "of the distribution x' + (y - beta x z) z' = 0"),
        parameter(&S::gamma, "gamma", "1/(m s)", -1e3, 1e3, "of the gyroscopic force; 0: reversible"),
        parameter(static_cast<int S::*>(&S::seed), "seed", "", 0, 1000000000,
                  "of the state at the start; 0: a fixed one")};
  }
  template <class T>
  void initial(Out<T> z) const {
    start<T>(z.first(3), z.subspan(3));
    z[3] = z[3] + beta * z[0] * z[2] * z[5];
    z[4] = z[4] + potential_y<T>(z);
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T v = z[4] - potential_y<T>(z);
    return (z[3] * z[3] + v * v + z[5] * z[5]) / 2 + spring_energy<T>(z.first(3));
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = T(1);
    rows[1] = T(0);
    rows[2] = q[1] - beta * q[0] * q[2];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
  }

 private:
  // a_y
  template <class T>
  [[nodiscard]] T potential_y(In<T> q) const {
    return -(gamma * q[0] * q[2]);
  }
};

const System<GyroscopicContactOscillator> registered{
    {.name = "gyroscopic-contact-oscillator",
     .title = "contact oscillator with a gyroscopic force, x' + (y - beta x z) z' = 0: not reversible",
     .reference = "modin-verdier2020",
     .description =
         "A relative of the contact oscillator that no involution reverses, linear or not: the "
         "exponents of its equilibria are not symmetric about zero, and no equilibrium has those of "
         "another with the opposite sign. Its energy is conserved. Take it to see what reversible "
         "methods owe to the reversibility of the usual test problems: on this one their energy "
         "error grows. With gamma = 0 it is reversible, which is the comparison to make.",
     .coordinates =
         {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}, {"p_z", "kg m/s"}},
     .invariants = {conserved("energy", "J")}}};
}  // namespace
