// A charged particle in the plane in a magnetic field so strong, or of a mass so small, that only the drift
// of the centre of its circles is left: per unit charge, position (x, y) in m, momentum p = A in Wb/m,
// r^2 = x^2 + y^2.
//
//   H = k r^2/2 (V),   phi_1 = p_x - A_x = 0,   phi_2 = p_y - A_y = 0 (Wb/m)
//   A = (b0/2 + b2 r^2/4) (-y, x),   b = d_x A_y - d_y A_x = b0 + b2 r^2 (T).
//
// It is the limit m -> 0 of H = |p - A|^2/(2 m) + k r^2/2, where the kinetic momentum p - A has to vanish
// (dunne-jackiw-trugenberger1990). The two constraints are second class, {phi_1, phi_2} = b, and Dirac's
// bracket of the plane is {x, y}_D = -1/b: position alone is a phase space, and the particle drifts across
// the electric field and the magnetic one, x' = -k y/b, y' = k x/b.
//
// Exact solution of Dirac's formulation from any state: x, y turn about the origin at the rate k/b(r), and
// p - A(x, y) stays what it is. The energy is conserved.
//
// Limit: W is singular where b vanishes, r^2 = -b0/b2 if that is positive.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct GuidingCentre {
  static constexpr int dimension = 4;
  static constexpr int constraint_count = 2;
  Real b0 = 1, b2 = 0.5_r, k = 0.2_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&GuidingCentre::b0, "b0", "T", -100, 100, "magnetic field at the origin"),
            parameter(&GuidingCentre::b2, "b2", "T/m^2", -100, 100, "growth of the magnetic field"),
            parameter(&GuidingCentre::k, "k", "V/m^2", -100, 100, "stiffness of the electric potential")};
  }
  static std::vector<std::string> constraint_names() { return {"p_x - A_x", "p_y - A_y"}; }

  /// b0/2 + b2 r^2/4: the vector potential is this times (-y, x).
  template <class T>
  T swirl(const T& x, const T& y) const {
    return b0 / 2 + b2 * (x * x + y * y) / 4;
  }
  template <class T>
  void initial(Out<T> z) const {
    const T x(1), y(Real::fraction(1, 2)), a = swirl(x, y);
    z[0] = x;
    z[1] = y;
    z[2] = -(a * y);
    z[3] = a * x;
  }
  template <class T>
  T hamiltonian(const T& /*t*/, In<T> z) const {
    return k * (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  template <class T>
  void constraints(const T& /*t*/, In<T> z, Out<T> phi) const {
    const T a = swirl(z[0], z[1]);
    phi[0] = z[2] + a * z[1];
    phi[1] = z[3] - a * z[0];
  }
  template <class T>
  void constraint_gradients(const T& /*t*/, In<T> z, Out<T> rows) const {
    const T a = swirl(z[0], z[1]), a_x = b2 * z[0] / 2, a_y = b2 * z[1] / 2;
    rows[0] = a_x * z[1];
    rows[1] = a + a_y * z[1];
    rows[2] = T(1);
    rows[4] = -a - a_x * z[0];
    rows[5] = -(a_y * z[0]);
    rows[7] = T(1);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = hamiltonian(t, z);
  }
  template <class T>
  void exact_solution(const T& elapsed, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const T a = swirl(z0[0], z0[1]);
    const T phase = k * elapsed / (b0 + b2 * (z0[0] * z0[0] + z0[1] * z0[1]));
    const T cosine = cos(phase), sine = sin(phase);
    z[0] = z0[0] * cosine - z0[1] * sine;
    z[1] = z0[1] * cosine + z0[0] * sine;
    z[2] = z0[2] + a * (z0[1] - z[1]);
    z[3] = z0[3] - a * (z0[0] - z[0]);
  }
};

const System<GuidingCentre> registered{
    {.name = "guiding-centre",
     .title = "drift of a charge across a strong magnetic field, H = k r^2/2 on p = A(x, y)",
     .reference = "dunne-jackiw-trugenberger1990; nguyen-turski (1.2)",
     .description =
         "A charge in a magnetic field so strong that only the drift of the centre of its circles is left: "
         "momenta are bound to positions by two second-class constraints. Take it as the example of "
         "constraints of the phase space that do not come from constraints of positions, with an exact "
         "solution. The constraint matrix is singular where the field vanishes.",
     .coordinates = {{"x", "m"}, {"y", "m"}, {"p_x", "Wb/m"}, {"p_y", "Wb/m"}},
     .invariants = {conserved_quadratic("energy", "V")}}};
}  // namespace
