// A bead with linear friction in a bowl of height c |q|^2/2, z = (q, v), q the horizontal position, v = q'.
// The mass matrix of unit mass is M = 1 + c^2 q q^T, and friction is nu times the velocity along the bowl,
// which the factor e^{nu t} in the action describes:
//
//   F = e^{nu t} (M v, 0),   B = e^{nu t} (v.Mv/2 + g c |q|^2/2),
//   K = e^{nu t} [[S, -M], [M, 0]],   S_12 = c^2 (q_2 v_1 - q_1 v_2)
//
// K depends on the state and on time. Darboux chart (q, e^{nu t} M v), cubic in the state, with the inverse
// M^-1 = 1 - c^2 q q^T/(1 + c^2 |q|^2), where the Hamiltonian is e^{-nu t} p.M^-1 p/2 + e^{nu t} g c |q|^2/2.
// The equations of motion are v' = -nu v - c (c |v|^2 + g) q/(1 + c^2 |q|^2). The moment
// e^{nu t} (q_1 v_2 - q_2 v_1) is conserved, the energy v.Mv/2 + g c |q|^2/2 decreases at the rate nu v.Mv.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct DampedBeadInBowl {
  static constexpr int dimension = 4;
  Real nu = 0.2_r, c = 1, g = 9.81_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&DampedBeadInBowl::nu, "nu", "1/s", 0, 10, "damping rate"),
            parameter(&DampedBeadInBowl::c, "c", "1/m", 0, 100, "curvature of the bowl at its bottom"),
            parameter(&DampedBeadInBowl::g, "g", "m/s^2", 0, 1e3, "gravity")};
  }

  /// v.Mv/2 + g c |q|^2/2.
  template <class T>
  T energy(In<T> z) const {
    const T climb = c * (z[0] * z[2] + z[1] * z[3]);
    return (z[2] * z[2] + z[3] * z[3] + climb * climb + g * (c * (z[0] * z[0] + z[1] * z[1]))) / 2;
  }
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return exp(nu * t) * energy<T>(z);
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    const T growth = exp(nu * t), climb = c * (c * (z[0] * z[2] + z[1] * z[3]));
    form[0] = growth * (z[2] + climb * z[0]);
    form[1] = growth * (z[3] + climb * z[1]);
    form[2] = form[3] = T(0);
  }
  template <class T>
  void chart(const T& t, In<T> z, Out<T> y) const {
    const T growth = exp(nu * t), climb = c * (c * (z[0] * z[2] + z[1] * z[3]));
    y[0] = z[0];
    y[1] = z[1];
    y[2] = growth * (z[2] + climb * z[0]);
    y[3] = growth * (z[3] + climb * z[1]);
  }
  template <class T>
  void chart_inverse(const T& t, In<T> y, Out<T> z) const {
    const T decay = exp(-(nu * t)), square = c * (c * (y[0] * y[0] + y[1] * y[1]));
    const T along = c * (c * (y[0] * y[2] + y[1] * y[3])) / (1 + square);
    z[0] = y[0];
    z[1] = y[1];
    z[2] = decay * (y[2] - along * y[0]);
    z[3] = decay * (y[3] - along * y[1]);
  }
  template <class T>
  T chart_hamiltonian(const T& t, In<T> y) const {
    const T square = y[0] * y[0] + y[1] * y[1], along = c * (y[0] * y[2] + y[1] * y[3]);
    const T kinetic = y[2] * y[2] + y[3] * y[3] - along * along / (1 + c * (c * square));
    return (exp(-(nu * t)) * kinetic + exp(nu * t) * (g * (c * square))) / 2;
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T square = c * (c * (z[0] * z[0] + z[1] * z[1]));
    const T pull = c * (c * (z[2] * z[2] + z[3] * z[3]) + g) / (1 + square);
    rate[0] = z[2];
    rate[1] = z[3];
    rate[2] = -(nu * z[2]) - pull * z[0];
    rate[3] = -(nu * z[3]) - pull * z[1];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = exp(nu * t) * (z[0] * z[3] - z[1] * z[2]);
    values[1] = energy<T>(z);
  }
};

const System<DampedBeadInBowl> registered{
    {.name = "damped-bead-in-bowl",
     .title = "bead with friction in a bowl, v' = -nu v - c (c |v|^2 + g) q/(1 + c^2 |q|^2)",
     .reference = "bateman1931; whittaker1937 chapter IV; su-qin (67)",
     .description = "A bead with friction in a parabolic bowl, in position and velocity, with a mass matrix "
                    "that depends on the position. Its structure depends on the state and on time and its "
                    "chart is cubic: take it as the hardest of the damped systems with a chart. The moment "
                    "about the axis decays exactly as e^{-nu t}; the bead spirals to the bottom.",
     .coordinates = {{"x", "m"}, {"y", "m"}, {"u", "m/s"}, {"v", "m/s"}},
     .initial = {1, 0, 0.5_r, 2},
     .invariants = {conserved("moment", "m^2/s"), decreasing("energy", "m^2/s^2")}}};
}  // namespace
