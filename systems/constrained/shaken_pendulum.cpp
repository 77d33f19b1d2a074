// A pendulum whose support is shaken up and down, as a constrained system with an explicit time: a bob of
// mass m at q = (x, y) in the plane, momentum p, on a rod of length l from the support s(t) = (0, a cos w t);
// gravity g along -y.
//
//   H = |p|^2/(2 m) + m g y,   phi = (|q - s|^2 - l^2)/2 = 0 (m^2),   hidden, with phi_t:
//   phi~ = (q - s).(p/m - s') = 0 (m^2/s),   h = |p/m - s'|^2 - (q - s).(g e_y + s''),   S = |q - s|^2/m
//
// In the angle th from the downward vertical it is th'' = -(g - a w^2 cos w t)/l sin th, whose upper position
// is stable for a^2 w^2 > 2 g l (landau-lifshitz1976 section 30). The support does work: no energy is
// conserved. The initial state of this file satisfies the constraints of both levels at t = 0 only.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct ShakenPendulum {
  static constexpr int dimension = 4;
  static constexpr int constraint_count = 1;
  Real mass = 1, length = 1, gravity = 9.81_r, amplitude = 0.1_r, frequency = 20;
  static std::vector<Parameter> parameters() {
    return {parameter(&ShakenPendulum::mass, "mass", "kg", 1e-3, 1e3, "mass of the bob"),
            parameter(&ShakenPendulum::length, "length", "m", 1e-3, 1e3, "length of the rod"),
            parameter(&ShakenPendulum::gravity, "gravity", "m/s^2", 0, 1e3, "acceleration along -y"),
            parameter(&ShakenPendulum::amplitude, "amplitude", "m", 0, 1e3, "a of the support, a cos w t"),
            parameter(&ShakenPendulum::frequency, "frequency", "1/s", 0, 1e3, "w of the support")};
  }
  static std::vector<std::string> constraint_names() { return {"rod"}; }
  // The rod at 37 degrees from the vertical, the bob moving at one length per second.
  template <class T>
  void initial(Out<T> z) const {
    z[0] = T(length * 3 / 5);
    z[1] = T(amplitude - length * 4 / 5);
    z[2] = T(mass * length * 4 / 5);
    z[3] = T(mass * length * 3 / 5);
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / (2 * mass);
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return mass * (gravity * q[1]);
  }
  template <class T>
  void holonomic(const T& t, In<T> q, Out<T> phi) const {
    const T y = q[1] - amplitude * cos(frequency * t);
    phi[0] = (q[0] * q[0] + y * y - length * length) / 2;
  }
};

const System<ShakenPendulum> registered{
    {.name = "shaken-pendulum",
     .title = "pendulum on a support that moves, |q - s(t)| = l, s = (0, a cos w t)",
     .reference = "landau-lifshitz1976 section 30",
     .description = "A pendulum whose support is shaken up and down, with a constraint that depends on time. "
                    "Take it to test what formulations and methods make of moving constraints, whose hidden "
                    "constraint contains the velocity of the support. No energy is conserved, and the "
                    "initial state is consistent at time 0 alone.",
     .coordinates = {{"x", "m"}, {"y", "m"}, {"p_x", "kg m/s"}, {"p_y", "kg m/s"}}}};
}  // namespace
