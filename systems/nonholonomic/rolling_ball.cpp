// A ball of mass m, radius r and moment of inertia I, homogeneous or hollow, that rolls without slipping on a
// horizontal table which turns at the rate Omega: contact point (x, y), attitude e.
//
// The attitude is a quaternion e = (e_0, e_1, e_2, e_3) != 0 of any length, so that no chart ends anywhere.
// With the quaternion units i_k the angular velocity in space is w_k = 2 e'.(i_k e)/|e|^2, and
//   H = (p_x^2 + p_y^2)/(2 m) + |e|^2 |p_e|^2/(8 I),   angular momentum L_k = p_e.(i_k e)/2 = I w_k
// is regular: it is the rotational energy and that of a change of |e|, which nothing couples to the rest. The
// constraint forces leave p_e.e alone; where it is zero, as at the start, |e| is constant.
//   v_x - r w_y + Omega y = 0,   v_y + r w_x - Omega x = 0          A v + b = 0 with b = Omega (y, -x)
//
// By v' = k Omega (-v_y, v_x), k = I/(I + m r^2), the contact point runs on a circle at the rate k Omega, 2/7
// of the table's for a homogeneous ball (neimark-fufaev1972); w_z is constant. The energy is not conserved,
// as the table does work; the moving energy H - Omega (m (x v_y - y v_x) + L_z) is (fasso-sansonetto2016).
// The centre of the circle is kept as k Omega x - v_y and k Omega y + v_x, which on a table at rest are the
// velocity. The mirror image of the motion run backwards is a motion: that is the reversal.
#include <array>

#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

// i_k e for k = 1, 2, 3.
template <class T>
std::array<std::array<T, 4>, 3> rotations(In<T> e) {
  return {
      {{T(-e[1]), e[0], T(-e[3]), e[2]}, {T(-e[2]), e[3], e[0], T(-e[1])}, {T(-e[3]), T(-e[2]), e[1], e[0]}}};
}

struct RollingBall {
  static constexpr int dimension = 12;
  static constexpr int velocity_constraint_count = 2;
  Real mass = 1, radius = 1, inertia = 0.4_r, omega = 0.9_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&RollingBall::mass, "mass", "kg", 1e-3, 1e3),
            parameter(&RollingBall::radius, "radius", "m", 1e-3, 1e3),
            parameter(&RollingBall::inertia, "inertia", "kg m^2", 1e-6, 1e6, "moment of inertia"),
            parameter(&RollingBall::omega, "omega", "rad/s", -1e3, 1e3, "angular velocity of the table")};
  }
  // On the turntable, and on a table at rest.
  static std::vector<Assignments> instances(bool /*full*/) { return {{}, {{"omega", "0"}}}; }
  static std::vector<std::string> velocity_constraint_names() { return {"rolling-x", "rolling-y"}; }
  // At (1, 0) with the velocity (0.2, 0.5) and a spin of 0.3 rad/s.
  template <class T>
  void initial(Out<T> z) const {
    const Real vx = Real::fraction(1, 5), vy = Real::fraction(1, 2);
    for (std::size_t k = 0; k < 12; ++k) z[k] = T(0);
    z[0] = z[2] = T(1);
    z[6] = T(mass * vx);
    z[7] = T(mass * vy);
    z[9] = T(2 * inertia * (omega - vy) / radius);  // p_e = 2 I w e
    z[10] = T(2 * inertia * vx / radius);
    z[11] = T(2 * inertia * Real::fraction(3, 10));
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    T length(0), momentum(0);
    for (std::size_t k = 0; k < 4; ++k) {
      length = length + z[2 + k] * z[2 + k];
      momentum = momentum + z[8 + k] * z[8 + k];
    }
    return (z[6] * z[6] + z[7] * z[7]) / (2 * mass) + length * momentum / (8 * inertia);
  }
  template <class T>
  void velocity_constraints(const T& /*t*/, In<T> q, Out<T> rows) const {
    const In<T> e = q.subspan(2);
    const auto turned = rotations<T>(e);
    const T scale = 2 * radius / (e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]);
    rows[0] = rows[7] = T(1);
    rows[1] = rows[6] = T(0);
    for (std::size_t k = 0; k < 4; ++k) {
      rows[2 + k] = -(scale * turned[1][k]);
      rows[8 + k] = scale * turned[0][k];
    }
  }
  template <class T>
  void velocity_offsets(const T& /*t*/, In<T> q, Out<T> b) const {
    b[0] = omega * q[1];
    b[1] = -(omega * q[0]);
  }
  // The mirror image in the plane y = 0, of velocities with the opposite sign. Angular velocities are axial:
  // reflected they turn their x and z components.
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    constexpr std::array<int, 12> sign{1, -1, 1, -1, 1, -1, -1, 1, -1, 1, -1, 1};
    for (std::size_t k = 0; k < 12; ++k) reversed[k] = sign[k] > 0 ? z[k] : T(-z[k]);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const In<T> e = z.subspan(2, 4), p = z.subspan(8, 4);
    const auto turned = rotations<T>(e);
    T spin(0), radial(0);
    for (std::size_t k = 0; k < 4; ++k) {
      spin = spin + p[k] * turned[2][k] / 2;
      radial = radial + p[k] * e[k];
    }
    const Real rate = omega * inertia / (inertia + mass * radius * radius);
    values[0] = hamiltonian(t, z) - omega * (z[0] * z[7] - z[1] * z[6] + spin);
    values[1] = spin;
    values[2] = rate * z[0] - z[7] / mass;
    values[3] = rate * z[1] + z[6] / mass;
    values[4] = radial;
  }
};

const System<RollingBall> registered{
    {.name = "rolling-ball",
     .title = "ball rolling on a turntable, v' = k Omega (-v_y, v_x), k = I/(I + m r^2)",
     .reference = "neimark-fufaev1972; fasso-sansonetto2016",
     .description =
         "A ball that rolls on a table, at rest or turning (omega), with the attitude as a quaternion "
         "of any length, regular everywhere. Take it for affine constraints A v + b = 0: the table "
         "does work, the energy changes, and a moving energy is conserved in its place. The contact "
         "point runs on a circle that closes after 2 pi/(k Omega); of the attitude there is no closed "
         "form unless the table is at rest.",
     .coordinates = {{"x", "m"},
                     {"y", "m"},
                     {"e_0", ""},
                     {"e_1", ""},
                     {"e_2", ""},
                     {"e_3", ""},
                     {"p_x", "kg m/s"},
                     {"p_y", "kg m/s"},
                     {"p_0", "kg m^2/s"},
                     {"p_1", "kg m^2/s"},
                     {"p_2", "kg m^2/s"},
                     {"p_3", "kg m^2/s"}},
     .invariants = {conserved("moving-energy", "J"), conserved_quadratic("spin", "kg m^2/s"),
                    conserved("centre-x", "m/s"), conserved("centre-y", "m/s"),
                    conserved_quadratic("radial-momentum", "kg m^2/s")}}};
}  // namespace
