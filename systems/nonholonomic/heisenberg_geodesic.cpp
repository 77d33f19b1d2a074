// Sub-Riemannian geodesics of the Heisenberg group: shortest curves for the length of (x', y') among those
// with z' = (x y' - y x')/2, which are the motion of an unconstrained canonical Hamiltonian,
//
//   H = (P_1^2 + P_2^2)/2,   P_1 = p_x - y p_z/2,   P_2 = p_y + x p_z/2          (montgomery2002 chapter 1)
//
// x' = P_1, y' = P_2, and (P_1, P_2) turns at the constant rate w = p_z: (x, y) runs on a circle and z grows
// by the area that the chord from the origin sweeps. Conserved are the energy, p_z, and p_x + y p_z/2 and p_y
// - x p_z/2, the momenta of the translations of the group.
//
// Among constrained mechanical systems this is the vakonomic motion for the distribution of contact-particle,
// written with zeta = x y/2 - z in place of z, but with the kinetic energy (x'^2 + y'^2)/2, without the z'^2
// that a free particle has.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>
#include <pfaff/systems/nonholonomic/circular_path.hpp>

namespace {
using namespace pfaff;

struct HeisenbergGeodesic {
  static constexpr int dimension = 6;
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T first = z[3] - z[1] * z[5] / 2, second = z[4] + z[0] * z[5] / 2;
    return (first * first + second * second) / 2;
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = z[5];
    values[2] = z[3] + z[1] * z[5] / 2;
    values[3] = z[4] - z[0] * z[5] / 2;
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T half = z0[5] / 2, first = z0[3] - z0[1] * half, second = z0[4] + z0[0] * half;
    const CircularPath<T> path = circular_path(z0[5], elapsed);
    const T dx = first * path.along - second * path.across, dy = second * path.along + first * path.across;
    z[0] = z0[0] + dx;
    z[1] = z0[1] + dy;
    z[2] = z0[2] + (z0[0] * dy - z0[1] * dx) / 2 + (first * first + second * second) * path.area;
    z[3] = z0[3] - dy * half;
    z[4] = z0[4] + dx * half;
    z[5] = z0[5];
  }
};

const System<HeisenbergGeodesic> registered{
    {.name = "heisenberg-geodesic",
     .title =
         "sub-Riemannian geodesics of the Heisenberg group, H = ((p_x - y p_z/2)^2 + (p_y + x p_z/2)^2)/2",
     .reference = "montgomery2002 chapter 1",
     .description =
         "Shortest curves with z' = (x y' - y x')/2, a canonical Hamiltonian system without "
         "constraints whose (x, y) runs on circles. It is the vakonomic counterpart of "
         "contact-particle: the same distribution, in the coordinate x y/2 - z for z, and the "
         "kinetic energy (x'^2 + y'^2)/2; the vakonomic formulation of contact-particle itself also "
         "counts z'^2. Take it as a non-separable problem with a closed solution; its Hamiltonian is "
         "degenerate, as no momentum moves z by itself.",
     .coordinates = {{"x", "m"}, {"y", "m"}, {"z", "m^2"}, {"p_x", "m/s"}, {"p_y", "m/s"}, {"p_z", "1/s"}},
     .initial = {0.3_r, Real::fraction(-1, 2), 0.2_r, 0.8_r, 0.6_r, 1},
     .invariants = {conserved("energy", "m^2/s^2"), conserved("momentum-z", "1/s"),
                    conserved("translation-x", "m/s"), conserved("translation-y", "m/s")}}};
}  // namespace
