// <one line: what moves, and its energy>, H = |p|^2/(2 m) + k (q1^4 + q2^4)/4.
//
// Copy to systems/<name>.cpp. Parameters are Reals, formulas templates over the scalar T. Nothing else is
// needed: forces, Jacobians, brackets and series are derived from the two energies, and every method that
// fits runs. Other shapes a system may have: core/system.hpp lists them.
#include <pfaff/core/system.hpp>

namespace {  // every plug-in, or two files with a struct of one name would be merged silently
using namespace pfaff;

struct QuarticTrap {
  static constexpr int dimension = 4;  // q1, q2, p1, p2; a member function where it depends on parameters
  Real mass = 1, stiffness = 0.5_r;    // decimals as 0.5_r: exact in double and in quad
  static std::vector<Parameter> parameters() {
    return {parameter(&QuarticTrap::mass, "mass", "kg", 1e-3, 1e3, "of the particle"),
            parameter(&QuarticTrap::stiffness, "stiffness", "N/m^3", 0, 1e3, "of the trap")};
  }

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / (2 * mass);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T a = q[0] * q[0], b = q[1] * q[1];
    return stiffness * (a * a + b * b) / 4;
  }

  // Optional: anything derived may be written out for speed; it is checked against the derivation.
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    for (std::size_t k = 0; k < 2; ++k) f[k] = -(stiffness * q[k] * q[k] * q[k]);
  }

  // Optional: what is watched along a run, in the order of the descriptor's list.
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(2)) + potential(t, z.first(2));
  }
};

const System<QuarticTrap> registered{
    {.name = "template-system",  // kebab-case, unique
     .title = "particle in a quartic trap, m q'' + k q^3 = 0",
     .reference = "hairer-lubich-wanner2006 I.1",
     .description = "A particle in a quartic trap, the template of a system. Say what moves and what the "
                    "system is good for. Say where it ends, too.",  // key in references.bib, equation
     .coordinates = {{"q1", "m"}, {"q2", "m"}, {"p1", "kg m/s"}, {"p2", "kg m/s"}},
     .initial = {1, 0.5_r, 0, 0.2_r},
     .invariants = {conserved("energy", "J")}}};
}  // namespace
