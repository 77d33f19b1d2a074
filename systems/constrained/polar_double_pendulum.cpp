// The plane double pendulum in relative polar coordinates, as a constrained system with a mass matrix that
// depends on the positions: bob 1 at r_1 (sin th_1, -cos th_1), bob 2 at r_2 (sin th_2, -cos th_2) from bob
// 1; angles from the downward vertical; masses m_k, rods of length l_k, gravity g.
//
//   q = (r_1, th_1, r_2, th_2),   H = p^T M(q)^-1 p/2 + V,   phi_k = r_k - l_k = 0 (m)
//
// With e_k = (sin th_k, -cos th_k), n_k = (cos th_k, sin th_k) the Cartesian momenta P_k of the bobs satisfy
//   P_1 + P_2 = p_r1 e_1 + (p_th1/r_1) n_1,   P_2 = p_r2 e_2 + (p_th2/r_2) n_2,
//   H = |P_1|^2/(2 m_1) + |P_2|^2/(2 m_2) - m_1 g r_1 cos th_1 - m_2 g (r_1 cos th_1 + r_2 cos th_2).
// dphi/dq is constant, all the geometry is in M: S = [[1/m_1, -c/m_1], [-c/m_1, 1/m_1 + 1/m_2]] with c =
// cos(th_1 - th_2). On the surface the motion is that of two rods in Cartesian coordinates (nguyen-turski
// appendix B). The energy is conserved, and without gravity the angular momentum p_th1 + p_th2.
//
// Limit: the coordinates are singular at r_k = 0.
#include <array>

#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct PolarDoublePendulum {
  static constexpr int dimension = 8;
  static constexpr int constraint_count = 2;
  Real m1 = 1, m2 = 0.5_r, l1 = 1, l2 = 0.8_r, gravity = 9.81_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&PolarDoublePendulum::m1, "m1", "kg", 1e-3, 1e3, "mass of the first bob"),
            parameter(&PolarDoublePendulum::m2, "m2", "kg", 1e-3, 1e3, "mass of the second bob"),
            parameter(&PolarDoublePendulum::l1, "l1", "m", 1e-3, 1e3, "length of the first rod"),
            parameter(&PolarDoublePendulum::l2, "l2", "m", 1e-3, 1e3, "length of the second rod"),
            parameter(&PolarDoublePendulum::gravity, "gravity", "m/s^2", 0, 1e3, "acceleration downwards")};
  }
  static std::vector<std::string> constraint_names() { return {"rod1", "rod2"}; }
  [[nodiscard]] std::vector<Invariant> invariant_list() const {
    std::vector<Invariant> list{conserved("energy", "J")};
    if (gravity.is(0)) list.push_back(conserved("angular-momentum", "kg m^2/s"));
    return list;
  }
  // Both bobs move across their rods, th_1' = 1/2 and th_2' = -1 per second: the radial momenta are those
  // that keep r_k' = 0 as the rods are not parallel.
  template <class T>
  void initial(Out<T> z) const {
    const T first(Real::fraction(2, 5)), second(Real::fraction(-3, 4));
    const T rate1(Real::fraction(1, 2)), rate2(-1);
    const T c = cos(first - second), s = sin(first - second);
    z[0] = T(l1);
    z[1] = first;
    z[2] = T(l2);
    z[3] = second;
    z[4] = m2 * (l2 * rate2) * s;
    z[5] = l1 * ((m1 + m2) * (l1 * rate1) + m2 * (l2 * rate2) * c);
    z[6] = -(m2 * (l1 * rate1) * s);
    z[7] = l2 * (m2 * (l2 * rate2 + l1 * rate1 * c));
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    const T s1 = sin(z[1]), c1 = cos(z[1]), s2 = sin(z[3]), c2 = cos(z[3]);
    const T across1 = z[5] / z[0], across2 = z[7] / z[2];
    const std::array<T, 2> both{z[4] * s1 + across1 * c1, across1 * s1 - z[4] * c1};
    const std::array<T, 2> second{z[6] * s2 + across2 * c2, across2 * s2 - z[6] * c2};
    const T first_x = both[0] - second[0], first_y = both[1] - second[1];
    return (first_x * first_x + first_y * first_y) / (2 * m1) +
           (second[0] * second[0] + second[1] * second[1]) / (2 * m2) -
           gravity * ((m1 + m2) * (z[0] * c1) + m2 * (z[2] * c2));
  }
  template <class T>
  void holonomic(const T& /*t*/, In<T> q, Out<T> phi) const {
    phi[0] = q[0] - l1;
    phi[1] = q[2] - l2;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
    if (gravity.is(0)) values[1] = z[5] + z[7];
  }
};

const System<PolarDoublePendulum> registered{
    {.name = "polar-double-pendulum",
     .title = "plane double pendulum in polar coordinates, H = p.M(q)^-1 p/2 + V on r_1 = l_1, r_2 = l_2",
     .reference = "landau-lifshitz1976 section 5; nguyen-turski (4.1), (4.2)",
     .description = "The double pendulum in polar coordinates, whose mass matrix depends on the positions "
                    "while its constraints are linear. Take it to test formulations and methods where all "
                    "the geometry is in the mass matrix. The coordinates are singular where a radius "
                    "vanishes, and the energy is not separable, which excludes RATTLE.",
     .coordinates = {{"r_1", "m"},
                     {"theta_1", "rad"},
                     {"r_2", "m"},
                     {"theta_2", "rad"},
                     {"p_r1", "kg m/s"},
                     {"p_theta1", "kg m^2/s"},
                     {"p_r2", "kg m/s"},
                     {"p_theta2", "kg m^2/s"}}}};
}  // namespace
