// The contact oscillator in momenta changed by a gradient, P = p - grad S with S = sigma cos z:
//
//   H = (|P + grad S|^2 + |q|^2 + epsilon x^2 z^2)/2,   x' + y z' = 0,   grad S = (0, 0, -sigma sin z)
//
// The change is canonical, a gauge term dS/dt in the Lagrangian: positions and velocities move as those of
// the contact oscillator do. P -> -P does not reverse the motion any more; (q, P) -> (q, -P - 2 grad S) does.
// So the system tests methods that work with momenta; to those that work with (q, v) it looks as reversible
// as before.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/nonholonomic/contact_oscillator.hpp>

namespace {
using namespace pfaff;

struct ContactOscillatorConjugate : ContactOscillator {
  Real sigma = 0.5_r;
  static std::vector<Parameter> parameters() {
    using S = ContactOscillatorConjugate;
    return {
        parameter(static_cast<Real S::*>(&S::epsilon), "epsilon", "1/m^2", 0, 1e3, "of epsilon x^2 z^2/2"),
        parameter(&S::sigma, "sigma", "kg m^2/s", -1e3, 1e3, "of the gauge S = sigma cos z"),
        parameter(static_cast<int S::*>(&S::seed), "seed", "", 0, 1000000000,
                  "of the state at the start; 0: a fixed one")};
  }
  template <class T>
  void initial(Out<T> z) const {
    start<T>(z.first(3), z.subspan(3));
    z[5] = z[5] - slope(z[2]);
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T p = z[5] + slope(z[2]);
    return (z[3] * z[3] + z[4] * z[4] + p * p) / 2 + spring_energy<T>(z.first(3));
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    for (std::size_t k = 0; k < 3; ++k) {
      reversed[k] = z[k];
      reversed[3 + k] = -z[3 + k];
    }
    reversed[5] = reversed[5] - 2 * slope(z[2]);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = (z[1] * z[1] + z[4] * z[4]) / 2;
  }

 private:
  template <class T>
  [[nodiscard]] T slope(const T& z) const {
    return -(sigma * sin(z));
  }
};

const System<ContactOscillatorConjugate> registered{
    {.name = "contact-oscillator-conjugate",
     .title = "contact oscillator in the momenta P = p - grad S, S = sigma cos z",
     .reference = "modin-verdier2020",
     .description =
         "The contact oscillator with its momenta changed by a gradient, a gauge term of the "
         "Lagrangian: the motion in positions and velocities is the same, and momenta reversed do not "
         "reverse it. Take it to see whether a method depends on the choice of momenta. Methods that "
         "work with positions and velocities cannot tell the two apart.",
     .coordinates =
         {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}, {"p_z", "kg m/s"}},
     .invariants = {conserved("energy", "J"), conserved_quadratic("energy-y", "J")}}};
}  // namespace
