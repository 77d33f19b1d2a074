// A free particle on a sphere: mass m, position q in space, momentum p, radius r.
//
//   H = |p|^2/(2 m),   phi = (|q|^2 - r^2)/2 = 0 (m^2),   hidden: phi~ = q.p/m = 0 (m^2/s)
//   S = |q|^2/m,   {phi~, H} = |p|^2/m^2.
//
// Dirac's brackets, off the surface too: {q_i, q_j} = 0, {q_i, p_j} = delta_ij - q_i q_j/|q|^2,
// {p_i, p_j} = -(q_i p_j - q_j p_i)/|q|^2. Conserved are the energy and the angular momentum L = q x p.
//
// Exact solution of Dirac's formulation, from any state with q != 0: great circles. q and p turn about L at
// the rate |L|/(m |q|^2), so that |q|, |p| and q.p stay what they are. On the surface that is the motion of
// every formulation.
#include <array>

#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct SphereParticle {
  static constexpr int dimension = 6;
  static constexpr int constraint_count = 1;
  Real mass = 1, radius = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&SphereParticle::mass, "mass", "kg", 1e-3, 1e3, "mass of the particle"),
            parameter(&SphereParticle::radius, "radius", "m", 1e-3, 1e3, "radius of the sphere")};
  }
  static std::vector<std::string> constraint_names() { return {"sphere"}; }
  // At (2, -1, 2)/3 radii, with a velocity of (1, 4, 1)/5 radii per second.
  template <class T>
  void initial(Out<T> z) const {
    constexpr std::array<int, 3> place{2, -1, 2}, speed{1, 4, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      z[k] = T(radius * place[k] / 3);
      z[3 + k] = T(mass * radius * speed[k] / 5);
    }
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
    phi[0] = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - radius * radius) / 2;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3));
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      values[1 + a] = z[b] * z[3 + c] - z[c] * z[3 + b];
    }
  }
  // A vector u in the plane of q and p turns by the angle |L| s, s = t/(m |q|^2): u cos |L|s + (L x u)
  // sin(|L| s)/|L|, where L x q = p |q|^2 - q (q.p) and L x p = p (q.p) - q |p|^2.
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const In<T> q = z0.first(3), p = z0.subspan(3);
    const T qq = q[0] * q[0] + q[1] * q[1] + q[2] * q[2], qp = q[0] * p[0] + q[1] * p[1] + q[2] * p[2],
            pp = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    const T s = elapsed / (mass * qq);
    T square(0);  // |L|^2, without the cancellation of |q|^2 |p|^2 - (q.p)^2
    for (std::size_t a = 0; a < 3; ++a) {
      const T component = q[(a + 1) % 3] * p[(a + 2) % 3] - q[(a + 2) % 3] * p[(a + 1) % 3];
      square = square + component * component;
    }
    const T size = sqrt(select(square, square, T(1)));
    const T cosine = select(square, cos(size * s), T(1));
    const T sine = select(square, sin(size * s) / size, s);
    for (std::size_t k = 0; k < 3; ++k) {
      z[k] = q[k] * cosine + (p[k] * qq - q[k] * qp) * sine;
      z[3 + k] = p[k] * cosine + (p[k] * qp - q[k] * pp) * sine;
    }
  }
};

const System<SphereParticle> registered{
    {.name = "sphere-particle",
     .title = "free particle on a sphere, H = |p|^2/(2 m) on |q| = r",
     .reference = "nguyen-turski (1.2), (4.1), (4.2)",
     .description = "A free particle on a sphere, the simplest holonomic constraint, with an exact solution "
                    "of Dirac's formulation on and off the surface. Take it as a first test of formulations "
                    "and of methods on the constraint surface: energy and all angular momenta are conserved. "
                    "It is too symmetric to show every error.",
     .coordinates =
         {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}, {"p_z", "kg m/s"}},
     .invariants = {conserved_quadratic("energy", "J"), conserved_quadratic("angular-momentum-x", "kg m^2/s"),
                    conserved_quadratic("angular-momentum-y", "kg m^2/s"),
                    conserved_quadratic("angular-momentum-z", "kg m^2/s")}}};
}  // namespace
