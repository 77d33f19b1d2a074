// The heavy top: a rigid body with one point fixed, under gravity, in the body frame. z = (Pi, Gamma): the
// angular momentum and the upward vertical; principal moments of inertia I_a, mass times position of the
// centre of mass c, gravity g.
//
//   H = sum Pi_a^2/(2 I_a) + g Gamma.c
//   Pi' = Pi x Omega + g Gamma x c,   Gamma' = Gamma x Omega,   Omega_a = Pi_a/I_a
//
// with the Lie-Poisson bracket of se(3)*,
//   {f, h} = -Pi.(f_Pi x h_Pi) - Gamma.(f_Pi x h_Gamma - h_Pi x f_Gamma)   (marsden-ratiu1999 section 1.4),
// whose Casimirs are |Gamma|^2 and Pi.Gamma. Conserved are these and the energy. The top of Lagrange, I_1 =
// I_2 and c along the third axis, also keeps Pi_3 and is integrable. Without gravity or with c = 0 it is the
// free rigid body.
#include <array>

#include <pfaff/brackets/lie_poisson.hpp>
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct HeavyTop {
  static constexpr int dimension = 6;
  Real i1 = 2, i2 = 2, i3 = 1, c1 = 0, c2 = 0, c3 = 1, gravity = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&HeavyTop::i1, "i1", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&HeavyTop::i2, "i2", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&HeavyTop::i3, "i3", "kg m^2", 1e-3, 1e3, "principal moment of inertia"),
            parameter(&HeavyTop::c1, "c1", "kg m", -1e3, 1e3, "mass times position of the centre of mass"),
            parameter(&HeavyTop::c2, "c2", "kg m", -1e3, 1e3, "its second component"),
            parameter(&HeavyTop::c3, "c3", "kg m", -1e3, 1e3, "its third component"),
            parameter(&HeavyTop::gravity, "gravity", "m/s^2", 0, 1e3, "acceleration along -Gamma")};
  }
  // Three different moments, and a centre of mass off every axis.
  static std::vector<Assignments> instances(bool /*full*/) {
    return {{}, {{"i1", "1"}, {"i2", "2"}, {"i3", "4"}, {"c1", "0.3"}, {"c2", "-0.4"}, {"c3", "0.5"}}};
  }
  [[nodiscard]] bool symmetric() const { return i1 == i2 && c1.is(0) && c2.is(0); }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    std::vector<Invariant> list{conserved("energy", "J"), conserved_quadratic("gamma-squared", ""),
                                conserved_quadratic("pi-gamma", "kg m^2/s")};
    if (symmetric()) list.push_back(conserved("axial-momentum", "kg m^2/s"));
    return list;
  }
  [[nodiscard]] LiePoissonBracket bracket() const { return LiePoissonBracket::se3(-1); }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return (z[0] * z[0] / i1 + z[1] * z[1] / i2 + z[2] * z[2] / i3) / 2 +
           gravity * (c1 * z[3] + c2 * z[4] + c3 * z[5]);
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const std::array<T, 3> omega{z[0] / i1, z[1] / i2, z[2] / i3};
    const std::array<Real, 3> torque{gravity * c1, gravity * c2, gravity * c3};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
      rate[a] = z[b] * omega[d] - z[d] * omega[b] + z[3 + b] * torque[d] - z[3 + d] * torque[b];
      rate[3 + a] = z[3 + b] * omega[d] - z[3 + d] * omega[b];
    }
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = z[3] * z[3] + z[4] * z[4] + z[5] * z[5];
    values[2] = z[0] * z[3] + z[1] * z[4] + z[2] * z[5];
    if (symmetric()) values[3] = z[2];
  }
};

const System<HeavyTop> registered{
    {.name = "heavy-top",
     .title = "heavy top, Pi' = Pi x Omega + g Gamma x c, Gamma' = Gamma x Omega, on se(3)*",
     .reference = "marsden-ratiu1999 section 1.4",
     .description = "A rigid body with one point fixed under gravity, in the body frame: six variables with "
                    "the Lie-Poisson bracket of se(3)* and two Casimirs. Take it to test what methods do to "
                    "Casimirs and energy on a larger Lie-Poisson system. It is integrable from every state "
                    "for the tops of Euler, Lagrange and Kovalevskaya only; others are chaotic.",
     .coordinates = {{"pi_1", "kg m^2/s"},
                     {"pi_2", "kg m^2/s"},
                     {"pi_3", "kg m^2/s"},
                     {"gamma_1", ""},
                     {"gamma_2", ""},
                     {"gamma_3", ""}},
     .initial = {0.4_r, Real::fraction(-1, 5), 3, Real::fraction(3, 5), 0, Real::fraction(4, 5)}}};
}  // namespace
