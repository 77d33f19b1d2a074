// A model of the quadrupole vibrations of an atomic nucleus,
//   H = a (|p|^2 + |q|^2)/2 + b q1 (3 q2^2 - q1^2)/sqrt 2 + d |q|^4/4.
// With d = 0 and a = 1 it is the Henon-Heiles problem of lambda = 3 b/sqrt 2 with q1 and q2 exchanged.
#include <pfaff/core/system.hpp>
#include <pfaff/systems/canonical/reversed_momenta.hpp>

namespace {
using namespace pfaff;

struct QuadrupoleBoson {
  static constexpr int dimension = 4;
  Real a = 1, b = 0.55_r, d = 0.4_r;
  static std::vector<Parameter> parameters() {
    using S = QuadrupoleBoson;
    return {parameter(&S::a, "a", "", 0, 100, "frequency of small vibrations"),
            parameter(&S::b, "b", "", 0, 100, "strength of the cubic coupling"),
            parameter(&S::d, "d", "", 0, 100, "strength of the quartic coupling")};
  }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return a * (p[0] * p[0] + p[1] * p[1]) / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    const T square = q[0] * q[0] + q[1] * q[1];
    return a * square / 2 + cubic<T>() * q[0] * (3 * (q[1] * q[1]) - q[0] * q[0]) + d * (square * square) / 4;
  }
  template <class T>
  void force(const T& /*t*/, In<T> q, Out<T> f) const {
    const T pull = a + d * (q[0] * q[0] + q[1] * q[1]), coupling = 3 * cubic<T>();
    f[0] = -(pull * q[0]) - coupling * (q[1] * q[1] - q[0] * q[0]);
    f[1] = -q[1] * (pull + 2 * coupling * q[0]);
  }
  template <class T>
  void velocity(const T& /*t*/, In<T> p, Out<T> v) const {
    v[0] = a * p[0];
    v[1] = a * p[1];
  }
  template <class T>
  void reversal(const T& /*t*/, In<T> z, Out<T> reversed) const {
    reverse_momenta<T>(z, reversed);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = kinetic(t, z.subspan(2)) + potential(t, z.first(2));
  }

 private:
  template <class T>
  [[nodiscard]] T cubic() const {
    return T(b) / sqrt(T(2));
  }
};

const System<QuadrupoleBoson> registered{
    {.name = "quadrupole-boson",
     .title = "quadrupole boson, H = a (|p|^2 + |q|^2)/2 + b q1 (3 q2^2 - q1^2)/sqrt 2 + d |q|^4/4",
     .reference = "rackauckas-nie2017",
     .description =
         "Two coupled oscillators with a cubic and a quartic coupling, a model of the vibrations of "
         "a nucleus. Take it beside henon-heiles for chaotic motion that stays bounded at every "
         "energy. Its usual state has the energy 120, far from small vibrations, and asks for "
         "small steps.",
     .coordinates = {{"q1", ""}, {"q2", ""}, {"p1", ""}, {"p2", ""}},
     .initial = {4.919080920016389_r, 2.836942666663649_r, 0, 0},
     .invariants = {conserved("energy", "")},
     .time_unit = ""}};
}  // namespace
