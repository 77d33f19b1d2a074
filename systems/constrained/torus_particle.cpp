// A free particle on a torus about the z axis: mass m, position q in space, momentum p; the radius R of the
// centre line and r < R of the tube. With rho^2 = x^2 + y^2,
//
//   H = |p|^2/(2 m),   phi = ((rho - R)^2 + z^2 - r^2)/2 = 0 (m^2),   hidden: phi~ = grad phi.p/m = 0
//   (m^2/s),   S = ((rho - R)^2 + z^2)/m.
//
// The motion is along geodesics. Conserved are the energy and, as the torus is one of revolution, the angular
// momentum x p_y - y p_x about its axis (Clairaut's integral, docarmo1976 section 4-4); both off the surface
// too in Dirac's formulation. Closed forms: the equators rho = R + r and rho = R - r, the first stable, and
// the meridians. It has no bracket that is simpler than the dense Dirac bracket.
//
// Limits: phi has no gradient on the axis, S vanishes on the centre line of the tube.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct TorusParticle {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;
  Real mass = 1, radius = 2, tube = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&TorusParticle::mass, "mass", "kg", 1e-3, 1e3, "mass of the particle"),
            parameter(&TorusParticle::radius, "radius", "m", 1e-3, 1e3, "radius R of the centre line"),
            parameter(&TorusParticle::tube, "tube", "m", 1e-3, 1e3, "radius r of the tube, less than R")};
  }
  static std::vector<std::string> constraint_names() { return {"torus"}; }
  // In the half plane y = 0, x > 0, at the tube's angle with cosine 4/5; a velocity of 3/10 m/s along the
  // meridian and 1/2 m/s along the parallel.
  template <class T>
  void initial(Out<T> z) const {
    z[0] = T(radius + tube * 4 / 5);
    z[1] = T(0);
    z[2] = T(tube * 3 / 5);
    z[3] = T(mass * Real::fraction(-9, 50));
    z[4] = T(mass * Real::fraction(1, 2));
    z[5] = T(mass * Real::fraction(6, 25));
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / (2 * mass);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    const T across = sqrt(q[0] * q[0] + q[1] * q[1]) - radius;
    phi[0] = (across * across + q[2] * q[2] - tube * tube) / 2;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3));
    values[1] = z[0] * z[4] - z[1] * z[3];
  }
};

const System<TorusParticle> registered{
    {.name = "torus-particle",
     .title = "free particle on a torus, H = |p|^2/(2 m) on (rho - R)^2 + z^2 = r^2",
     .reference = "docarmo1976 section 4-4; nguyen-turski (1.2)",
     .description =
         "A free particle on a torus, moving along geodesics. Take it as a nonlinear constraint without a "
         "simple Dirac bracket: energy and the angular momentum about the axis are conserved. The inner "
         "equator is unstable, and the constraint has no gradient on the axis of the torus.",
     .coordinates =
         {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}, {"p_z", "kg m/s"}},
     .invariants = {conserved_quadratic("energy", "J"),
                    conserved_quadratic("angular-momentum-z", "kg m^2/s")}}};
}  // namespace
