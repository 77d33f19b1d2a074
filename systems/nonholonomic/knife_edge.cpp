// A knife edge on an incline: a body of mass m and moment of inertia J whose centre of mass (x, y), x down
// the slope, moves along its own direction theta only; g is the acceleration along the slope.
//
//   H = (p_x^2 + p_y^2)/(2 m) + p_theta^2/(2 J) - m g x,   A = (sin theta, -cos theta, 0)
//
// omega = theta' is constant and the speed along the edge obeys u' = g cos theta (neimark-fufaev1972). With F
// = int cos theta dt and G = int sin theta dt since the start, which is a circular path, u = u_0 + g F and
//   x = x_0 + u_0 F + g F^2/2,   y = y_0 + u_0 G + g (F G/2 + int (F G' - G F')/2 dt):
// for omega != 0 the edge does not slide down, but drifts across the slope along a cycloid.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>
#include <pfaff/systems/nonholonomic/circular_path.hpp>

namespace {
using namespace pfaff;

struct KnifeEdge {
  static constexpr int dimension = 6;
  static constexpr int velocity_constraint_count = 1;
  Real mass = 1, inertia = 0.5_r, gravity = 4.9_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&KnifeEdge::mass, "mass", "kg", 1e-3, 1e3),
            parameter(&KnifeEdge::inertia, "inertia", "kg m^2", 1e-3, 1e3, "moment of inertia"),
            parameter(&KnifeEdge::gravity, "gravity", "m/s^2", 0, 1e3, "acceleration down the slope")};
  }
  static std::vector<std::string> velocity_constraint_names() { return {"knife-edge"}; }
  // At the origin, running at 0.7 m/s and turning at 1.3 rad/s.
  template <class T>
  void initial(Out<T> z) const {
    const T theta(Real::fraction(3, 10)), momentum(mass * Real::fraction(7, 10));
    z[0] = z[1] = T(0);
    z[2] = theta;
    z[3] = momentum * cos(theta);
    z[4] = momentum * sin(theta);
    z[5] = T(inertia * Real::fraction(13, 10));
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / (2 * mass) + p[2] * p[2] / (2 * inertia);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -(mass * (gravity * q[0]));
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = sin(q[2]);
    rows[1] = -cos(q[2]);
    rows[2] = T(0);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3)) + potential(t, z.first(3));
    values[1] = z[5];
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T s0 = sin(z0[2]), c0 = cos(z0[2]), speed = (z0[3] * c0 + z0[4] * s0) / mass;
    const T omega = z0[5] / inertia, theta = z0[2] + omega * elapsed;
    const CircularPath<T> path = circular_path(omega, elapsed);
    const T f = c0 * path.along - s0 * path.across, g = s0 * path.along + c0 * path.across;
    const T momentum = mass * (speed + gravity * f);
    z[0] = z0[0] + speed * f + gravity * (f * f / 2);
    z[1] = z0[1] + speed * g + gravity * (f * g / 2 + path.area);
    z[2] = theta;
    z[3] = momentum * cos(theta);
    z[4] = momentum * sin(theta);
    z[5] = z0[5];
  }
};

const System<KnifeEdge> registered{
    {.name = "knife-edge",
     .title = "knife edge on an incline, u' = g cos theta, theta' constant",
     .reference = "neimark-fufaev1972",
     .description =
         "A skate on an inclined plane that turns at a constant rate. Take it as a problem with a "
         "potential and a closed solution: while it turns it does not slide down, but drifts across "
         "the slope along a cycloid. The exact solution holds for states that satisfy the constraint.",
     .coordinates = {{"x", "m"},
                     {"y", "m"},
                     {"theta", "rad"},
                     {"p_x", "kg m/s"},
                     {"p_y", "kg m/s"},
                     {"p_theta", "kg m^2/s"}},
     .invariants = {conserved("energy", "J"), conserved("angular-momentum", "kg m^2/s")}}};
}  // namespace
