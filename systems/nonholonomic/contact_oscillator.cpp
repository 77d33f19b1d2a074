// The contact oscillator of McLachlan and Perlmutter (mclachlan-perlmutter2006):
//
//   H = (|p|^2 + |q|^2 + epsilon x^2 z^2)/2,   x' + y z' = 0
//
// The constraint leaves y alone, y'' = -y, so that H_y = (y^2 + p_y^2)/2 is conserved beside H. For epsilon =
// 0 the rest is a linear oscillator in z driven through y, integrable; epsilon = 0.3 is the perturbation of
// the source.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>
#include <pfaff/systems/nonholonomic/contact_oscillator.hpp>

namespace {
using namespace pfaff;

struct PlainContactOscillator : ContactOscillator {
  static std::vector<Parameter> parameters() {
    using S = PlainContactOscillator;
    return {
        parameter(static_cast<Real S::*>(&S::epsilon), "epsilon", "1/m^2", 0, 1e3, "of epsilon x^2 z^2/2"),
        parameter(static_cast<int S::*>(&S::seed), "seed", "", 0, 1000000000,
                  "of the state at the start; 0: a fixed one")};
  }
  static std::vector<Assignments> instances(bool /*full*/) { return {{}, {{"epsilon", "0"}}}; }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    return {epsilon.is(0) ? conserved_quadratic("energy", "J") : conserved("energy", "J"),
            conserved_quadratic("energy-y", "J")};
  }
  template <class T>
  void initial(Out<T> z) const {
    start<T>(z.first(3), z.subspan(3));
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return spring_energy<T>(q);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3)) + potential(t, z.first(3));
    values[1] = (z[1] * z[1] + z[4] * z[4]) / 2;
  }
};

const System<PlainContactOscillator> registered{
    {.name = "contact-oscillator",
     .title = "contact oscillator, H = (|p|^2 + |q|^2 + epsilon x^2 z^2)/2 with x' + y z' = 0",
     .reference = "mclachlan-perlmutter2006",
     .description =
         "An oscillator in space with the contact constraint, the usual test problem of nonholonomic "
         "integrators. It is reversible, and the energy of y is conserved by itself: methods that are "
         "reversible keep the energy for long times, which flatters them. See "
         "gyroscopic-contact-oscillator for a relative that is not reversible. The parameter seed "
         "draws states at random.",
     .coordinates = {
         {"x", "m"}, {"y", "m"}, {"z", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}, {"p_z", "kg m/s"}}}};
}  // namespace
