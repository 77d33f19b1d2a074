// A free particle of unit mass whose velocity stays in the contact distribution of dz - y dx, the smallest
// constraint that cannot be integrated:
//
//   H = |p|^2/2,   A = (-y, 0, 1),   x'' = -y x' y'/(1 + y^2),   y'' = 0,   z'' = x' y'/(1 + y^2)
//
// (pitanga-rodrigues (36)-(41); bates-sniatycki1993). Conserved are the energy, p_y and p_x sqrt(1 + y^2).
// With b = p_y, C = x' sqrt(1 + y^2), s = sqrt(1 + y^2) the motion is y = y_0 + b t,
//   x = x_0 + (C/b) (asinh y - asinh y_0),   z = z_0 + (C/b) (s - s_0).
// Neither difference is formed: (s - s_0)/b = t (y + y_0)/(s + s_0), and asinh y - asinh y_0 = asinh w with
// w = s_0 y - s y_0 = b t (1 + s s_0 - y y_0)/(s + s_0).
#include <cstdint>

#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

// asinh(w)/w, 1 at 0.
template <class T>
T cardinal_asinh(const T& w) {
  // The ratio of successive coefficients of the series is -(2 k - 1)^2/(2 k (2 k + 1)); for |w| <= 1/10 the
  // term left out is below 1e-37.
  const T square = w * w;
  T series(1);
  for (std::int64_t k = 18; k >= 1; --k)
    series = 1 - square * Real::fraction((2 * k - 1) * (2 * k - 1), 2 * k * (2 * k + 1)) * series;
  const T large = square - Real::fraction(1, 100), size = select(large, select(w, w, -w), T(1));
  return select(large, log(size + sqrt(1 + size * size)) / size, series);
}

struct ContactParticle {
  static constexpr int dimension = 6;
  static constexpr int velocity_constraint_count = 1;
  static std::vector<std::string> velocity_constraint_names() { return {"contact"}; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> /*q*/) const {
    return T(0);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    rows[0] = -q[1];
    rows[1] = T(0);
    rows[2] = T(1);
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(3));
    values[1] = z[4];
    values[2] = z[3] * sqrt(1 + z[1] * z[1]);
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T& y0 = z0[1];
    const T y = y0 + z0[4] * elapsed, s0 = sqrt(1 + y0 * y0), s = sqrt(1 + y * y);
    const T product = y * y0, c = z0[3] * s0;
    // s s_0 - y y_0, whose terms cancel where y and y_0 have the same sign
    const T cosh = select(product, (1 + y * y + y0 * y0) / (s * s0 + product), s * s0 - product);
    const T mean = elapsed * (1 + cosh) / (s + s0);
    z[0] = z0[0] + c * mean * cardinal_asinh(T(z0[4] * mean));
    z[1] = y;
    z[2] = z0[2] + c * elapsed * (y + y0) / (s + s0);
    z[3] = c / s;
    z[4] = z0[4];
    z[5] = y * z[3];
  }
};

const System<ContactParticle> registered{
    {.name = "contact-particle",
     .title = "free particle with z' = y x': x'' = -y x' y'/(1 + y^2), y'' = 0, z'' = x' y'/(1 + y^2)",
     .reference = "pitanga-rodrigues (36)-(41); bates-sniatycki1993",
     .description =
         "A free particle whose velocity stays in the contact distribution of the Heisenberg group. "
         "Take it as the smallest example of a constraint of velocities that is none of positions, "
         "and to compare nonholonomic with vakonomic motion, which differ on it. The exact solution "
         "and the third invariant hold for states that satisfy the constraint.",
     .coordinates =
         {{"x", "m"}, {"y", "m"}, {"z", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}, {"p_z", "kg m/s"}},
     .initial = {0.3_r, 0.5_r, Real::fraction(-1, 5), 0.8_r, 0.6_r, 0.4_r},
     .invariants = {conserved_quadratic("energy", "J"), conserved("momentum-y", "kg m/s"),
                    conserved("momentum-along", "kg m/s")}}};
}  // namespace
