// A charged particle in the plane, in a uniform magnetic field across it that changes in time, in the
// electric field that the change induces, and in an anharmonic electric trap; z = (x, y, u, v), u = x', v =
// y'; per unit charge and mass, r^2 = x^2 + y^2 (lewis-riesenfeld1969, who have lambda = 0).
//
//   u' = b v + e_x,  v' = -b u + e_y,   b = b0 (1 + epsilon cos wt)
//   e = -(k + lambda r^2) (x, y) - b' (-y, x)/2,   D = (e_x, e_y, -u, -v)
//   K_12 = b,  K_13 = K_24 = -1,  the other K_ij with i < j zero
//
// Written by the fields alone, as K zdot + D = 0, without potentials: that it is self-adjoint, b' = d_2 D_1 -
// d_1 D_2, is Faraday's law, curl e = -b'. K depends on time alone, so that a Darboux chart is derived. The
// induced field does work on the charge; conserved is the canonical angular momentum x v - y u + b r^2/2.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct MagneticInduction {
  static constexpr int dimension = 4;
  Real b0 = 1, epsilon = 0.5_r, omega = 1, k = 0.2_r, lambda = 0.5_r;
  static std::vector<Parameter> parameters() {
    return {
        parameter(&MagneticInduction::b0, "b0", "1/s", -100, 100, "mean gyration frequency"),
        parameter(&MagneticInduction::epsilon, "epsilon", "", 0, 10, "relative change of the magnetic field"),
        parameter(&MagneticInduction::omega, "omega", "1/s", 0, 100, "frequency of the change"),
        parameter(&MagneticInduction::k, "k", "1/s^2", -100, 100, "stiffness of the trap"),
        parameter(&MagneticInduction::lambda, "lambda", "1/(m^2 s^2)", 0, 100, "its growth with r^2")};
  }

  template <class T>
  T magnetic(const T& t) const {
    return b0 * (1 + epsilon * cos(omega * t));
  }
  template <class T>
  void structure(const T& t, In<T> /*z*/, Out<T> K) const {
    K[1] = magnetic(t);
    K[4] = -K[1];
    K[2] = K[7] = T(-1);
    K[8] = K[13] = T(1);
  }
  template <class T>
  void covector(const T& t, In<T> z, Out<T> D) const {
    const T slope = -(b0 * epsilon * omega) * sin(omega * t);
    const T pull = k + lambda * (z[0] * z[0] + z[1] * z[1]);
    D[0] = slope * z[1] / 2 - pull * z[0];
    D[1] = -(slope * z[0] / 2) - pull * z[1];
    D[2] = -z[2];
    D[3] = -z[3];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    const T square = z[0] * z[0] + z[1] * z[1];
    values[0] = z[0] * z[3] - z[1] * z[2] + magnetic(t) * square / 2;
    values[1] = (z[2] * z[2] + z[3] * z[3] + square * (k + lambda * square / 2)) / 2;
  }
};

const System<MagneticInduction> registered{
    {.name = "magnetic-induction",
     .title = "charged particle in the plane, magnetic field b0 (1 + epsilon cos wt), induced field, trap",
     .reference = "lewis-riesenfeld1969",
     .description = "A charged particle in a magnetic field that changes in time, with the induced electric "
                    "field and an anharmonic trap. It is written by its fields alone, K zdot + D = 0, "
                    "without potentials, and its Darboux chart is derived: take it as the example of such "
                    "systems. Only the canonical angular momentum is conserved.",
     .coordinates = {{"x", "m"}, {"y", "m"}, {"u", "m/s"}, {"v", "m/s"}},
     .initial = {1, 0, 0.2_r, 0.6_r},
     .invariants = {conserved("angular-momentum", "m^2/s"), {"energy", "m^2/s^2", Behaviour::free}}}};
}  // namespace
