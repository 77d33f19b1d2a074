// The Henon-Heiles problem, H = (|p|^2 + |q|^2)/2 + lambda (q1^2 q2 - q2^3/3); chaotic for energies near 1/6.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

struct HenonHeiles {
  static constexpr int dimension = 4;
  Real lambda = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&HenonHeiles::lambda, "lambda", "", 0, 10, "strength of the cubic coupling")};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return (q[0] * q[0] + q[1] * q[1]) / 2 + lambda * (q[0] * q[0] * q[1] - q[1] * q[1] * q[1] / 3);
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    f[0] = -q[0] - lambda * (2 * q[0] * q[1]);
    f[1] = -q[1] - lambda * (q[0] * q[0] - q[1] * q[1]);
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = p[0];
    v[1] = p[1];
  }
  // Two oscillators, which turn in their phase planes, and the cubic potential, which pushes.
  static constexpr int part_count = 2;
  static constexpr std::size_t small_part = 1;
  static std::vector<std::string> part_names() { return {"oscillators", "cubic potential"}; }
  template <class T>
  Status part_flow(std::size_t part, const T& h, In<T> z, Out<T> change) const {
    if (part == small_part) {
      change[0] = change[1] = T(0);
      change[2] = -(h * lambda * (2 * z[0] * z[1]));
      change[3] = -(h * lambda * (z[0] * z[0] - z[1] * z[1]));
      return Status::converged;
    }
    T sine, cosine;
    sine_cosine(T(h / 2), sine, cosine);
    const T turned = 2 * sine * cosine, less = -(2 * sine * sine);  // sin h and cos h - 1
    for (std::size_t k = 0; k < 2; ++k) {
      change[k] = less * z[k] + turned * z[2 + k];
      change[2 + k] = less * z[2 + k] - turned * z[k];
    }
    return Status::converged;
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(2)) + potential(t, z.first(2));
  }
};

const System<HenonHeiles> registered{
    {.name = "henon-heiles",
     .title = "Henon-Heiles problem",
     .reference = "henon-heiles1964; hairer-lubich-wanner2006 (I.3.10)",
     .description = "Two coupled oscillators with a cubic potential, a star's motion in the plane of an "
                    "axially symmetric galaxy. Take it for motion between order and chaos: orbits are mostly "
                    "regular at low energies and mostly chaotic near 1/6. Only the energy is conserved, and "
                    "above 1/6 orbits can escape to infinity.",
     .coordinates = {{"q1", ""}, {"q2", ""}, {"p1", ""}, {"p2", ""}},
     .initial = {0, 0.1_r, 0.5_r, 0},
     .invariants = {conserved("energy", "")},
     .time_unit = ""}};
}  // namespace
