// The sleigh of Chaplygin and Caratheodory: a rigid body of mass m and moment of inertia J on a plane, whose
// knife edge, r behind the centre of mass (x, y), moves along its own direction theta only.
//
//   H = (p_x^2 + p_y^2)/(2 m) + p_theta^2/(2 J),   A = (-sin theta, cos theta, -r),   A v = 0
//
// With the speed u of the edge and omega = theta', x' = u cos theta - r omega sin theta, y' = u sin theta +
// r omega cos theta, and for I = J/m + r^2
//   u' = r omega^2,   omega' = -r u omega/I,   u^2 + I omega^2 = c^2          (pitanga-rodrigues (29)-(35)).
// So u = c sin phi, sqrt(I) |omega| = c cos phi with the Gudermannian angle phi(t) = gd(k (t - t*)), k = r
// c/I: the sleigh ends up running straight ahead, its centre of mass in front. The angle is theta = theta_0 +
// a (phi
// - phi_0), a = sign(omega) sqrt(I)/r, and the edge is displaced by
//   (I/r) int tan(phi) e^{i theta} dphi.
// Subtracting from e^{i a phi} its interpolant L = cos(a pi/2) + i sin(a pi/2) sin(phi) at +-pi/2 leaves an
// integrand that is analytic for |phi| < 3 pi/2, which Gauss's rule integrates, and integrals that are known:
//   int tan dphi = log D,   int tan sin dphi = k t - sin(phi) + sin(phi_0),   D = cos(phi_0)/cos(phi).
// For |a| <= 15, that is J <= 200 m r^2, the 40 nodes are good to 1e-30.
#include <pfaff/core/numbers/elliptic.hpp>
#include <pfaff/core/numbers/gauss_legendre.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

const std::vector<QuadratureNode>& nodes() {
  static const std::vector<QuadratureNode> list = gauss_legendre(40);
  return list;
}

// How far the sleigh has got in its turn, phi_0 -> phi.
template <class T>
struct Turn {
  T sine0, cosine0, sine, cosine;  // of phi_0 and of phi
  T gap;                           // phi - phi_0
  T logarithm;                     // log D
};

// From phi_0, for x = k t. D = ((1 + sin phi_0) e^x + (1 - sin phi_0) e^-x)/2 is a sum of positive terms; the
// smaller of the two brackets comes from their product cos^2 phi_0, and e^|x| is divided out, so that nothing
// cancels or overflows. A sleigh that does not turn, cos phi_0 = 0, keeps going as it does.
template <class T>
Turn<T> turn_of(const T& sine0, const T& cosine0, const T& x) {
  const T square = cosine0 * cosine0, length = select(x, x, -x), decay = exp(-length);
  const T size = select(sine0, sine0, -sine0), larger = 1 + size, smaller = square / larger;
  const T up = select(sine0, larger, smaller), down = select(sine0, smaller, larger);
  const T growing = select(x, up, down), falling = select(x, down, up);
  const T sum = select(square, growing + falling * decay * decay, T(2));
  const T difference = growing - falling * decay * decay;
  Turn<T> turn{sine0,
               cosine0,
               select(square, select(x, difference, -difference) / sum, sine0),
               2 * cosine0 * decay / sum,
               T(0),
               select(square, length + log(sum / 2), sine0 * x)};
  // tan((phi - phi_0)/2)
  const T rise = cosine0 * select(x, 1 - decay, decay - 1);
  const T run = select(square, growing + falling * decay, T(2)), norm = sqrt(rise * rise + run * run);
  turn.gap = 2 * angle_of(run / norm, rise / norm);
  return turn;
}

struct Sleigh {
  static constexpr int dimension = 6;
  static constexpr int velocity_constraint_count = 1;
  Real mass = 1, inertia = 0.5_r, offset = 0.4_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&Sleigh::mass, "mass", "kg", 1e-3, 1e3),
            parameter(&Sleigh::inertia, "inertia", "kg m^2", 1e-3, 1e3,
                      "moment of inertia about the centre of mass"),
            parameter(&Sleigh::offset, "offset", "m", 1e-3, 1e3,
                      "of the centre of mass ahead of the knife edge")};
  }
  static std::vector<std::string> velocity_constraint_names() { return {"knife-edge"}; }
  // The edge at the origin, running at 0.6 m/s and turning at 1.1 rad/s.
  template <class T>
  void initial(Out<T> z) const {
    const T theta(Real::fraction(1, 5)), s = sin(theta), c = cos(theta);
    const T speed(Real::fraction(3, 5)), across(offset * Real::fraction(11, 10));
    z[0] = offset * c;
    z[1] = offset * s;
    z[2] = theta;
    z[3] = mass * (speed * c - across * s);
    z[4] = mass * (speed * s + across * c);
    z[5] = T(inertia * Real::fraction(11, 10));
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / (2 * mass) + p[2] * p[2] / (2 * inertia);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -sin(q[2]);
    rows[1] = cos(q[2]);
    rows[2] = T(-offset);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3));
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const Real moment = inertia / mass + offset * offset, root = sqrt(moment), ratio = root / offset;
    const T s0 = sin(z0[2]), c0 = cos(z0[2]);
    const T along = (z0[3] * c0 + z0[4] * s0) / mass, across = root * z0[5] / inertia;
    const T square = along * along + across * across, size = sqrt(select(square, square, T(1)));
    const T speed = select(square, size, T(0));  // c
    const T side = select(across, T(1), T(-1));
    const T x = offset / moment * speed * elapsed;
    const Turn<T> turn = turn_of(T(along / size), T(select(square, side * across / size, T(1))), x);
    const T theta = z0[2] + side * ratio * turn.gap;

    T edge_x, edge_y;
    edge_path(z0[2], side, turn, x, edge_x, edge_y);
    const T s = sin(theta), c = cos(theta), u = speed * turn.sine, omega = side * speed * turn.cosine / root;
    z[0] = z0[0] + moment / offset * edge_x + offset * (c - c0);
    z[1] = z0[1] + moment / offset * edge_y + offset * (s - s0);
    z[2] = theta;
    z[3] = mass * (u * c - offset * omega * s);
    z[4] = mass * (u * s + offset * omega * c);
    z[5] = inertia * omega;
  }

 private:
  // int tan(phi) e^{i theta} dphi, as two coordinates.
  template <class T>
  void edge_path(const T& theta0, const T& side, const Turn<T>& turn, const T& x, T& edge_x,
                 T& edge_y) const {
    const Real ratio = sqrt(inertia / mass + offset * offset) / offset;
    const Real quarter = ratio * 1.57079632679489661923132169163975144_r, even = cos(quarter),
               odd = sin(quarter);
    const T phi0 = angle_of(turn.cosine0, turn.sine0), base = theta0 - side * ratio * phi0;
    // L e^{i base} = even + odd sin(phi), two complex constants.
    const T even_x = even * cos(base), even_y = even * sin(base);
    const T odd_x = -(side * odd * sin(base)), odd_y = side * odd * cos(base);
    T sum_x(0), sum_y(0);
    for (const QuadratureNode& node : nodes()) {
      const T ahead = node.place * turn.gap, phi = phi0 + ahead, sine = sin(phi);
      const T weight = node.weight * sine / cos(phi), theta = theta0 + side * ratio * ahead;
      sum_x = sum_x + weight * (cos(theta) - even_x - odd_x * sine);
      sum_y = sum_y + weight * (sin(theta) - even_y - odd_y * sine);
    }
    const T rest = x - (turn.sine - turn.sine0);
    edge_x = turn.gap * sum_x + even_x * turn.logarithm + odd_x * rest;
    edge_y = turn.gap * sum_y + even_y * turn.logarithm + odd_y * rest;
  }
};

const System<Sleigh> registered{
    {.name = "sleigh",
     .title = "Chaplygin-Caratheodory sleigh, u' = r omega^2, omega' = -r u omega/(J/m + r^2)",
     .reference = "pitanga-rodrigues (29)-(35); neimark-fufaev1972",
     .description =
         "A rigid body on a plane with a knife edge behind its centre of mass. Take it as the "
         "standard small test of velocity constraints: energy is conserved, yet every motion but "
         "the straight ones turns until the centre of mass runs ahead, so that no invariant volume "
         "exists. The exact solution is good to 1e-30 for inertia <= 200 mass offset^2 and holds for states "
         "that satisfy the constraint.",
     .coordinates = {{"x", "m"},
                     {"y", "m"},
                     {"theta", "rad"},
                     {"p_x", "kg m/s"},
                     {"p_y", "kg m/s"},
                     {"p_theta", "kg m^2/s"}},
     .invariants = {conserved_quadratic("energy", "J")}}};
}  // namespace
