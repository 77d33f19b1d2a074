// The system x'' + y' = 0, y'' + y = 0 of Hojman and Urrutia, which no Lagrangian in (x, y) describes, and in
// Birkhoff's form no Hamiltonian in its own variables z = (x, y, u, w), u = x', w = y'.
//
//   F = (y + u, 0, w, 0),   B = (u^2 + 2 y u - w^2)/2,
//   K_12 = K_13 = K_34 = -1, the other K_ij with i < j zero.
//
// With K_ij = d_i F_j - d_j F_i the rows of K z' = grad B are -y' - u' = 0, x' = u, x' - w' = u + y, u' = -w:
// the equations of motion, with no sign changed. F.dz = (y + u) dx + w du gives the Darboux chart
// (x, u; y + u, w) =: (q; p), with H = p_1 q_2 - (q_2^2 + p_2^2)/2. Conserved are B, c = y + u, the energy
// (y^2 + w^2)/2 of the second equation and x - w - c t. Lengths have the unit frequency of y.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct HojmanUrrutia {
  static constexpr int dimension = 4;

  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    return (z[2] * z[2] + 2 * z[1] * z[2] - z[3] * z[3]) / 2;
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    form[0] = z[1] + z[2];
    form[1] = T(0);
    form[2] = z[3];
    form[3] = T(0);
  }
  template <class T>
  void chart(const T& /*t*/, In<T> z, Out<T> y) const {
    y[0] = z[0];
    y[1] = z[2];
    y[2] = z[1] + z[2];
    y[3] = z[3];
  }
  template <class T>
  void chart_inverse(const T& /*t*/, In<T> y, Out<T> z) const {
    z[0] = y[0];
    z[1] = y[2] - y[1];
    z[2] = y[1];
    z[3] = y[3];
  }
  template <class T>
  T chart_hamiltonian(const T& /*t*/, In<T> y) const {
    return y[2] * y[1] - (y[1] * y[1] + y[3] * y[3]) / 2;
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[2];
    rate[1] = z[3];
    rate[2] = -z[3];
    rate[3] = -z[1];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const T sum = z[1] + z[2];
    values[0] = birkhoffian(t, z);
    values[1] = (z[1] * z[1] + z[3] * z[3]) / 2;
    values[2] = sum;
    values[3] = z[0] - z[3] - t * sum;
  }
  // y and w turn; u = c - y; x - w grows at the rate c.
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T cosine = cos(elapsed), sine = sin(elapsed), sum = z0[1] + z0[2];
    z[1] = z0[1] * cosine + z0[3] * sine;
    z[3] = z0[3] * cosine - z0[1] * sine;
    z[0] = z0[0] - z0[3] + sum * elapsed + z[3];
    z[2] = sum - z[1];
  }
};

const System<HojmanUrrutia> registered{
    {.name = "hojman-urrutia",
     .title = "x'' + y' = 0, y'' + y = 0, which has no Lagrangian in x and y",
     .reference = "hojman-urrutia1981; su-qin (4), (5)",
     .description = "A linear system of two equations of second order that has no Lagrangian in its "
                    "coordinates, but a Birkhoffian. Take it to see that such systems are within reach: its "
                    "structure is constant, regular and not canonical, and four quantities are conserved. "
                    "One of these, and one coordinate, grow linearly in time.",
     .coordinates = {{"x", "m"}, {"y", "m"}, {"u", "m/s"}, {"w", "m/s"}},
     .initial = {1, 0.5_r, 0.3_r, 0.7_r},
     .invariants = {conserved_quadratic("birkhoffian", "m^2/s^2"), conserved_quadratic("energy", "m^2/s^2"),
                    conserved("sum", "m/s"), conserved("drift", "m")}}};
}  // namespace
