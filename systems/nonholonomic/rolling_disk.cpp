// A vertical disk of mass m and radius r that rolls on a plane without slipping: contact point (x, y),
// heading theta, angle of rolling phi; moments of inertia I about its axis and J about the vertical.
//
//   H = (p_x^2 + p_y^2)/(2 m) + p_theta^2/(2 J) + p_phi^2/(2 I),   x' = r cos(theta) phi',  y' = r sin(theta)
//   phi'
//
// The forces of the ground turn the velocity and do no more: theta' and phi' are constant (bloch2003 section
// 1.4) and the contact point runs on a circle of radius r |phi'/theta'|, or on a straight line.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>
#include <pfaff/systems/nonholonomic/circular_path.hpp>

namespace {
using namespace pfaff;

struct RollingDisk {
  static constexpr int dimension = 8;
  static constexpr int velocity_constraint_count = 2;
  Real mass = 1, radius = 0.5_r, axial = 0.125_r, vertical = 0.0625_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&RollingDisk::mass, "mass", "kg", 1e-3, 1e3),
            parameter(&RollingDisk::radius, "radius", "m", 1e-3, 1e3),
            parameter(&RollingDisk::axial, "axial-inertia", "kg m^2", 1e-6, 1e6,
                      "moment of inertia about the axis"),
            parameter(&RollingDisk::vertical, "vertical-inertia", "kg m^2", 1e-6, 1e6,
                      "moment of inertia about a diameter")};
  }
  static std::vector<std::string> velocity_constraint_names() { return {"rolling-x", "rolling-y"}; }
  // Rolling at 1.2 rad/s, turning at 0.7 rad/s.
  template <class T>
  void initial(Out<T> z) const {
    const Real rolling = Real::fraction(6, 5);
    const T theta(Real::fraction(3, 10)), momentum(mass * radius * rolling);
    z[0] = z[1] = T(0);
    z[2] = theta;
    z[3] = T(Real::fraction(1, 10));
    z[4] = momentum * cos(theta);
    z[5] = momentum * sin(theta);
    z[6] = T(vertical * Real::fraction(7, 10));
    z[7] = T(axial * rolling);
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / (2 * mass) + p[2] * p[2] / (2 * vertical) +
           p[3] * p[3] / (2 * axial);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = rows[5] = T(1);
    rows[1] = rows[2] = rows[4] = rows[6] = T(0);
    rows[3] = -(radius * cos(q[2]));
    rows[7] = -(radius * sin(q[2]));
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(4));
    values[1] = z[6];
    values[2] = z[7];
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T s0 = sin(z0[2]), c0 = cos(z0[2]), turning = z0[6] / vertical, rolling = z0[7] / axial;
    const T speed = radius * rolling, theta = z0[2] + turning * elapsed;
    const CircularPath<T> path = circular_path(turning, elapsed);
    z[0] = z0[0] + speed * (c0 * path.along - s0 * path.across);
    z[1] = z0[1] + speed * (s0 * path.along + c0 * path.across);
    z[2] = theta;
    z[3] = z0[3] + rolling * elapsed;
    z[4] = mass * speed * cos(theta);
    z[5] = mass * speed * sin(theta);
    z[6] = z0[6];
    z[7] = z0[7];
  }
};

const System<RollingDisk> registered{
    {.name = "rolling-disk",
     .title = "vertical rolling disk, x' = r cos(theta) phi', y' = r sin(theta) phi'",
     .reference = "bloch2003 section 1.4",
     .description =
         "A disk that rolls upright on a plane, with two constraints. Take it to test methods with "
         "several velocity constraints on a closed solution: a circle, or a straight line where the "
         "disk does not turn. The exact solution and the conserved axial momentum hold for states "
         "that satisfy the constraints.",
     .coordinates = {{"x", "m"},
                     {"y", "m"},
                     {"theta", "rad"},
                     {"phi", "rad"},
                     {"p_x", "kg m/s"},
                     {"p_y", "kg m/s"},
                     {"p_theta", "kg m^2/s"},
                     {"p_phi", "kg m^2/s"}},
     .invariants = {conserved_quadratic("energy", "J"), conserved_quadratic("momentum-theta", "kg m^2/s"),
                    conserved_quadratic("momentum-phi", "kg m^2/s")}}};
}  // namespace
