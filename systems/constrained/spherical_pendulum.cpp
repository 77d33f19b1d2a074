// The spherical pendulum as a constrained system: a bob of mass m at q in space, p its momentum, gravity g
// along -z, on a rigid massless rod of length l from the origin.
//
//   H = |p|^2/(2 m) + m g z,   phi = (|q|^2 - l^2)/2 = 0 (m^2),   hidden: phi~ = q.p/m = 0 (m^2/s)
//   S = |q|^2/m,   {phi~, H} = |p|^2/m^2 - g z,   the force of the rod: -q (|p|^2/m - m g z)/l^2.
//
// Conserved are the energy and the vertical angular momentum x p_y - y p_x, both off the surface too in
// Dirac's formulation, as L_z commutes with phi and with H. Closed forms: the conical pendulum turns at
// omega^2 = g/|z| with constant z < 0; with L_z = 0 it is the plane pendulum of frequency sqrt(g/l);
// height is an elliptic function of time (whittaker1937 section 55).
//
// Limit: S vanishes at q = 0, where the constraint has no gradient.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct SphericalPendulum {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;
  Real mass = 1, length = 1, gravity = 9.81_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&SphericalPendulum::mass, "mass", "kg", 1e-3, 1e3, "mass of the bob"),
            parameter(&SphericalPendulum::length, "length", "m", 1e-3, 1e3, "length of the rod"),
            parameter(&SphericalPendulum::gravity, "gravity", "m/s^2", 0, 1e3, "acceleration along -z")};
  }
  static std::vector<std::string> constraint_names() { return {"rod"}; }
  // The rod at 37 degrees from the vertical, the bob's velocity (4, 9, 3)/10 lengths per second.
  template <class T>
  void initial(Out<T> z) const {
    z[0] = T(length * 3 / 5);
    z[1] = T(0);
    z[2] = T(-(length * 4) / 5);
    z[3] = T(mass * length * 4 / 10);
    z[4] = T(mass * length * 9 / 10);
    z[5] = T(mass * length * 3 / 10);
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / (2 * mass);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return mass * (gravity * q[2]);
  }
  template <class T>
  void force(const T& /*t*/, In<T> /*q*/, Out<T> f) const {
    f[0] = f[1] = T(0);
    f[2] = T(-(mass * gravity));
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    for (std::size_t k = 0; k < 3; ++k) v[k] = p[k] / mass;
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - length * length) / 2;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3)) + potential(t, z.first(3));
    values[1] = z[0] * z[4] - z[1] * z[3];
  }
};

const System<SphericalPendulum> registered{
    {.name = "spherical-pendulum",
     .title = "spherical pendulum, H = |p|^2/(2 m) + m g z on |q| = l",
     .reference = "whittaker1937 section 55; nguyen-turski (4.1), (4.2)",
     .description = "A bob on a rigid rod in space, in Cartesian coordinates with one constraint. Take it as "
                    "the standard small test of constrained methods: claims on the constraint surface are "
                    "verified on it, against conical and plane pendula and elliptic functions. The "
                    "constraint has no gradient at the point of suspension.",
     .coordinates =
         {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}, {"p_z", "kg m/s"}},
     .invariants = {conserved("energy", "J"), conserved_quadratic("angular-momentum-z", "kg m^2/s")}}};
}  // namespace
