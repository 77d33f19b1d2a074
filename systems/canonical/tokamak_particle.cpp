// A charged particle in the magnetic field of a tokamak, axisymmetric about the z axis, in units of charge
// and mass one, of the major radius and of the field on the magnetic axis:
//
//   H = |p - A(x)|^2/2,   R^2 = x^2 + y^2,   r^2 = (R - 1)^2 + z^2
//   A = z/(2 R) e_R + r^2/(2 q R) e_phi - ln(R)/2 e_z
//   B = curl A = -z/(q R) e_R + 1/R e_phi + (R - 1)/(q R) e_z
//
// with the safety factor q (qin2013, he2015). Time is counted in gyrations, of the period 2 pi R at R. H is
// not separable. Conserved are the energy and, by the symmetry, the toroidal momentum x p_y - y p_x; the
// magnetic moment is so adiabatically.
//
// The start is (1.05, 0, 0) with the velocity (0, u, -2.059e-3): with u = 4.816e-4 particles are trapped
// between two mirrors, on a banana orbit, with twice that they go round. The field is singular on the z axis.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct TokamakParticle {
  static constexpr int dimension = 6;
  Real safety = 2, toroidal = 4.816e-4_r;
  static std::vector<Parameter> parameters() {
    using S = TokamakParticle;
    return {parameter(&S::safety, "q", "", 0.1, 100, "safety factor"),
            parameter(&S::toroidal, "u", "", -1, 1, "velocity along the torus at the start")};
  }
  template <class T>
  void vector_potential(const T& x, const T& y, const T& z, Out<T> a) const {
    const T square = x * x + y * y, radius = sqrt(square);
    const T along = ((radius - 1) * (radius - 1) + z * z) / (2 * safety * square), out = z / (2 * square);
    a[0] = out * x - along * y;
    a[1] = out * y + along * x;
    a[2] = -(log(square) / 4);
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    std::array<T, 3> a;
    vector_potential(z[0], z[1], z[2], Out<T>(a));
    T sum(0);
    for (std::size_t k = 0; k < 3; ++k) sum = sum + (z[3 + k] - a[k]) * (z[3 + k] - a[k]);
    return sum / 2;
  }
  template <class T>
  void initial(Out<T> z) const {
    z[0] = T(1.05_r);
    std::array<T, 3> a;
    vector_potential(T(z[0]), T(0), T(0), Out<T>(a));
    z[3] = a[0];
    z[4] = toroidal + a[1];
    z[5] = a[2] - 2.059e-3_r;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    values[1] = z[0] * z[4] - z[1] * z[3];
  }
};

const System<TokamakParticle> registered{
    {.name = "tokamak-particle",
     .title = "charged particle in the magnetic field of a tokamak, H = |p - A(x)|^2/2",
     .reference = "qin2013; he2015",
     .description =
         "A charged particle that gyrates about the field lines of an axisymmetric tokamak, in canonical "
         "coordinates with a vector potential. Take it for long runs of methods that need no separable "
         "energy: steps of a tenth of a gyration have to keep energy and toroidal momentum over the 10^4 "
         "gyrations of a banana orbit. Fields of other coils and collisions are not in it.",
     .coordinates = {{"x", ""}, {"y", ""}, {"z", ""}, {"p_x", ""}, {"p_y", ""}, {"p_z", ""}},
     .invariants = {conserved("energy", ""), conserved_quadratic("toroidal-momentum", "")},
     .time_unit = ""}};
}  // namespace
