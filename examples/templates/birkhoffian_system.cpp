// Damped particle in a quartic trap, m q'' + c q' + k q^3 = 0, in Birkhoff's form, z = (q, v), v = q', E =
// e^{c t/m}:
//
//   F = E (m v, 0),   B = E (m v^2/2 + k q^4/4),   K = m E [[0, -1], [1, 0]]
//
// Darboux chart y = (q, E m v). docs/generating-functions.md derives it and takes this code. Copy to
// systems/<name>.cpp.
#include <pfaff/core/system.hpp>

namespace {  // every plug-in, or two files with a struct of one name would be merged silently
using namespace pfaff;

struct DampedTrap {
  static constexpr int dimension = 2;
  Real mass = 2, damping = 0.3_r, stiffness = 1.5_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&DampedTrap::mass, "mass", "kg", 1e-3, 1e3),
            parameter(&DampedTrap::damping, "damping", "kg/s", 0, 1e3),
            parameter(&DampedTrap::stiffness, "stiffness", "N/m^3", 0, 1e3)};
  }
  template <class T>
  T growth(const T& t) const {
    return exp(damping / mass * t);
  }

  // The action F.dz - B dt.
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    const T q2 = z[0] * z[0];
    return growth(t) * (mass * z[1] * z[1] / 2 + stiffness * q2 * q2 / 4);
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = growth(t) * mass * z[1];
    form[1] = T(0);
  }

  // Coordinates in which K is constant, and the way back.
  template <class T>
  void chart(const T& t, In<T> z, Out<T> y) const {
    y[0] = z[0];
    y[1] = growth(t) * mass * z[1];
  }
  template <class T>
  void chart_inverse(const T& t, In<T> y, Out<T> z) const {
    z[0] = y[0];
    z[1] = y[1] / (growth(t) * mass);
  }

  // Optional, and worth it: the equations of motion as you know them. They are checked against F and B.
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -(damping * z[1] + stiffness * z[0] * z[0] * z[0]) / mass;
  }

  // Optional: what is watched along a run.
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    const T q2 = z[0] * z[0];
    values[0] = mass * z[1] * z[1] / 2 + stiffness * q2 * q2 / 4;
  }
};

const System<DampedTrap> registered{
    {.name = "template-birkhoffian",
     .title = "damped particle in a quartic trap, m q'' + c q' + k q^3 = 0",
     .reference = "su-qin (4), (92)-(94)",
     .description = "A damped particle in a quartic trap in Birkhoff's form, the template of such systems. "
                    "Say what moves and what the system is good for. Say where it ends, too.",
     .coordinates = {{"q", "m"}, {"v", "m/s"}},
     .initial = {1, 0.2_r},
     .invariants = {decreasing("energy", "J")}}};
}  // namespace
