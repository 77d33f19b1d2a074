// A charged particle in the plane, in a magnetic field across it and an electric field in it, in the velocity
// coordinates z = (x, y, u, v), u = x', v = y'; per unit charge and mass, r^2 = x^2 + y^2.
//
//   u' = b v - phi_x,  v' = -b u - phi_y,   b = b0 + b2 r^2,  phi = k r^2/2
//   F = (u + A_x, v + A_y, 0, 0),   A = (b0/2 + b2 r^2/4) (-y, x),  d_x A_y - d_y A_x = b,
//   B = (u^2 + v^2)/2 + phi,   K_12 = b, K_13 = K_24 = -1, the other K_ij with i < j zero.
//
// K is the canonical structure with the magnetic two-form b dx^dy, and depends on the state. Darboux chart
// (x, y, u + A_x, v + A_y), the canonical momenta, where H = |p - A|^2/2 + phi. Conserved are the energy B
// and, as b and phi are symmetric about the origin, the canonical angular momentum
// x v - y u + r^2 (b0/2 + b2 r^2/4).
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct MagneticPlanar {
  static constexpr int dimension = 4;
  Real b0 = 1, b2 = 0.5_r, k = 0.2_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&MagneticPlanar::b0, "b0", "1/s", -100, 100, "gyration frequency at the origin"),
            parameter(&MagneticPlanar::b2, "b2", "1/(m^2 s)", -100, 100, "growth of the magnetic field"),
            parameter(&MagneticPlanar::k, "k", "1/s^2", -100, 100, "stiffness of the electric potential")};
  }

  /// b0/2 + b2 r^2/4: the vector potential is this times (-y, x).
  template <class T>
  T swirl(const T& x, const T& y) const {
    return b0 / 2 + b2 * (x * x + y * y) / 4;
  }
  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    return (z[2] * z[2] + z[3] * z[3] + k * (z[0] * z[0] + z[1] * z[1])) / 2;
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    const T a = swirl(z[0], z[1]);
    form[0] = z[2] - a * z[1];
    form[1] = z[3] + a * z[0];
    form[2] = form[3] = T(0);
  }
  template <class T>
  void chart(const T& /*t*/, In<T> z, Out<T> y) const {
    const T a = swirl(z[0], z[1]);
    y[0] = z[0];
    y[1] = z[1];
    y[2] = z[2] - a * z[1];
    y[3] = z[3] + a * z[0];
  }
  template <class T>
  void chart_inverse(const T& /*t*/, In<T> y, Out<T> z) const {
    const T a = swirl(y[0], y[1]);
    z[0] = y[0];
    z[1] = y[1];
    z[2] = y[2] + a * y[1];
    z[3] = y[3] - a * y[0];
  }
  template <class T>
  T chart_hamiltonian(const T& /*t*/, In<T> y) const {
    const T a = swirl(y[0], y[1]), u = y[2] + a * y[1], v = y[3] - a * y[0];
    return (u * u + v * v + k * (y[0] * y[0] + y[1] * y[1])) / 2;
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T b = b0 + b2 * (z[0] * z[0] + z[1] * z[1]);
    rate[0] = z[2];
    rate[1] = z[3];
    rate[2] = b * z[3] - k * z[0];
    rate[3] = -(b * z[2]) - k * z[1];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const T square = z[0] * z[0] + z[1] * z[1];
    values[0] = birkhoffian(t, z);
    values[1] = z[0] * z[3] - z[1] * z[2] + square * swirl(z[0], z[1]);
  }
};

const System<MagneticPlanar> registered{
    {.name = "magnetic-planar",
     .title = "charged particle in the plane, magnetic field b0 + b2 r^2, electric potential k r^2/2",
     .reference = "littlejohn1983",
     .description =
         "A charged particle in the plane, in a magnetic field across it that depends on the radius and a "
         "quadratic electric potential, in position and velocity. Take it to test methods on a structure "
         "that depends on the state. Fast gyration limits the steps of explicit methods where the field is "
         "strong; energy and canonical angular momentum are conserved.",
     .coordinates = {{"x", "m"}, {"y", "m"}, {"u", "m/s"}, {"v", "m/s"}},
     .initial = {1, 0, 0.2_r, 0.6_r},
     .invariants = {conserved_quadratic("energy", "m^2/s^2"), conserved("angular-momentum", "m^2/s")}}};
}  // namespace
