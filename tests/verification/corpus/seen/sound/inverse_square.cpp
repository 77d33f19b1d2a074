// A particle in the potential g/(2 q^2) on a line, the relative motion of two Calogero particles, solved
// exactly: q(s)^2 = q^2 + 2 q p s + 2 E s^2, and q keeps its sign.
//
// Source: Calogero, J. Math. Phys. 12 (1971) 419; de Alfaro, Fubini, Furlan, Nuovo Cimento A 34 (1976)
// 569.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct InverseSquare {
  static constexpr int dimension = 2;
  Real g = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&InverseSquare::g, "g", "", 0.001, 1000, "strength of the repulsion")};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return g / (2 * q[0] * q[0]);
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    f[0] = g / (q[0] * q[0] * q[0]);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reversed[0] = z[0];
    reversed[1] = -z[1];
  }
  // The energy E, and the constants that the conformal symmetries make: q p - 2 E t and (q - p t)^2 + g
  // (t/q)^2.
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const T energy = z[1] * z[1] / 2 + g / (2 * z[0] * z[0]);
    const T straight = z[0] - z[1] * t, bent = t / z[0];
    values[0] = energy;
    values[1] = z[0] * z[1] - 2 * energy * t;
    values[2] = straight * straight + g * bent * bent;
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T twice = z0[1] * z0[1] + g / (z0[0] * z0[0]);  // 2 E
    const T rate = z0[1] / z0[0];
    const T growth = sqrt(1 + 2 * rate * elapsed + twice / (z0[0] * z0[0]) * elapsed * elapsed);
    z[0] = z0[0] * growth;
    z[1] = (z0[1] + twice / z0[0] * elapsed) / growth;
  }
};

const System<InverseSquare> registered{
    {.name = "inverse-square",
     .title = "particle in the potential g/(2 q^2), q'' = g/q^3",
     .reference = "whittaker1937",
     .description = "A particle that is scattered by an inverse square potential. Take it as a singular "
                    "problem with a known solution. It ends at q = 0, which no motion reaches.",
     .coordinates = {{"q", ""}, {"p", ""}},
     .initial = {1, -0.5_r},
     .invariants = {conserved("energy", ""), conserved("dilation", ""), conserved("expansion", "")},
     .time_unit = ""}};
}  // namespace
