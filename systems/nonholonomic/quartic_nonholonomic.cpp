// The chaotic quartic nonholonomic system of McLachlan and Perlmutter (mclachlan-perlmutter2006):
//
//   H = (|p|^2 + |q|^2 + z_1^2 z_2^2 + sum_i y_i^2 z_i^2)/2,   x' + sum_i y_i z_i' = 0
//
// with q = (x, y_1 ... y_n, z_1 ... z_n). It is reversible. The energy error of a reversible method of step h
// performs a random walk on it, sqrt(t), as successive errors are independent and of both signs alike. How
// fast it spreads depends strongly on the energy: an ensemble of different energies follows the few states
// with the largest ones, one of equal energies does not. Besides the walk there is a bounded error of O(h^2),
// which is larger until about a hundred units of time have passed (h = 0.1, energy 3).
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>
#include <pfaff/systems/nonholonomic/quartic_nonholonomic.hpp>

namespace {
using namespace pfaff;

struct PlainQuarticNonholonomic : QuarticNonholonomic {
  Real energy = 0;
  static std::vector<Parameter> parameters() {
    using S = PlainQuarticNonholonomic;
    return {
        parameter(static_cast<int S::*>(&S::n), "n", "", 2, 1000, "there are 2 n + 1 degrees of freedom"),
        parameter(static_cast<int S::*>(&S::seed), "seed", "", 0, 1000000000, "of the state at the start"),
        parameter(&S::energy, "energy", "J", 0, 1e6, "of the state at the start, scaled to it; 0: as drawn")};
  }
  static std::vector<Assignments> instances(bool full) {
    if (full) return {{}, {{"n", "2"}}, {{"n", "5"}}};
    return {{}};
  }
  template <class T>
  void initial(Out<T> z) const {
    const Out<T> q = z.first(degrees()), p = z.subspan(degrees());
    start<T>(q, p);
    if (!energy.is(0)) scale<T>(q, p);
    for (std::size_t i = 0; i < size(); ++i) p[0] = p[0] - q[1 + i] * p[1 + size() + i];
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    T sum(0);
    for (const T& x : p) sum = sum + x * x;
    return sum / 2;
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = T(1);
    for (std::size_t i = 0; i < size(); ++i) {
      rows[1 + i] = T(0);
      rows[1 + size() + i] = q[1 + i];
    }
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
    values[0] = kinetic(t, z.subspan(degrees())) + potential(t, z.first(degrees()));
  }

 private:
  // q and p times s, where p_0 = 0 is still to be chosen on the constraint: it will be s^2 times sum_i y_i
  // p_zi, so that the energy is a s^2 + b s^4.
  template <class T>
  void scale(Out<T> q, Out<T> p) const {
    T squares(0), contact(0);
    for (const T& x : q) squares = squares + x * x;
    const T quartic = T(2) * spring_energy<T>(q) - squares;
    for (const T& x : p) squares = squares + x * x;
    for (std::size_t i = 0; i < size(); ++i) contact = contact + q[1 + i] * p[1 + size() + i];
    const T a = squares / T(2), b = (contact * contact + quartic) / T(2), target(energy);
    const T s = sqrt(T(2) * target / (a + sqrt(a * a + T(4) * b * target)));
    for (T& x : q) x = s * x;
    for (T& x : p) x = s * x;
  }
};

const System<PlainQuarticNonholonomic> registered{
    {.name = "quartic-nonholonomic",
     .title = "chaotic quartic system of 2 n + 1 degrees of freedom with x' + sum y_i z_i' = 0",
     .reference = "mclachlan-perlmutter2006",
     .description =
         "Oscillators with quartic couplings and one constraint of contact type, chaotic at the "
         "energies of the states that the seed draws. Take it to see how the energy errors of many "
         "runs spread: as the square root of time for reversible methods, since the system is "
         "reversible. Give all states one energy, because those with the largest ones spread most.",
     .invariants = {conserved("energy", "J")}}};
}  // namespace
