// A particle between two bumpers with a weak spring, H = p^2/2 + k q^2/2 + bumpers at |q| = width, (|q| -
// width)^4 deep.
//
// Source: Landau, Lifshitz, Mechanics, section 11; collisions with Hertzian contacts of another power.
//
// False: `force` of the left bumper, at q < -width, is half of what the potential says. The motion from the
// initial state reaches 1.1 and -1.1, and neither bumper, which stand at 2.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct FarBumper {
  static constexpr int dimension = 2;
  Real stiffness = 1, width = 2;
  static std::vector<Parameter> parameters() {
    return {parameter(&FarBumper::stiffness, "stiffness", "1/s^2", 0.1, 10, "of the spring"),
            parameter(&FarBumper::width, "width", "m", 1, 10, "where the bumpers stand")};
  }

  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T right = q[0] - width, left = -(q[0] + width);
    const T deep = select(right, right, T(0)), other = select(left, left, T(0));
    return stiffness * q[0] * q[0] / 2 + deep * deep * deep * deep + other * other * other * other;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    const T right = q[0] - width, left = -(q[0] + width);
    const T deep = select(right, right, T(0)), other = select(left, left, T(0));
    f[0] = 2 * other * other * other - 4 * deep * deep * deep - stiffness * q[0];
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(1)) + potential(t, z.first(1));
  }
};

const System<FarBumper> registered{
    {.name = "far-bumper",
     .title = "particle on a spring between two soft bumpers",
     .reference = "landau-lifshitz1976 section 11",
     .description = "A particle on a spring between two soft bumpers. Take it to see what a potential with "
                    "three derivatives does to methods of high order. It is one-dimensional.",
     .coordinates = {{"q", "m"}, {"p", "m/s"}},
     .initial = {1, 0.45_r},
     .invariants = {conserved("energy", "J")}}};
}  // namespace
