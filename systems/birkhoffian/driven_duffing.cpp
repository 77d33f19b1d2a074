// Duffing's oscillator with damping and a periodic force, x'' + nu x' + a x + b x^3 = f cos(omega t), in
// Birkhoff's form, z = (x, p), p = x'; the potential a x^2/2 + b x^4/4 has two wells for a < 0 < b.
//
//   F = e^{nu t} (p/2, -x/2),   K = e^{nu t} [[0, -1], [1, 0]],
//   B = e^{nu t} (p^2/2 + nu x p/2 + a x^2/2 + b x^4/4 - f x cos(omega t))
//
// Darboux chart y = (x, e^{nu t} p), where the Hamiltonian is
//   H = e^{-nu t} y_2^2/2 + e^{nu t} (a y_1^2/2 + b y_1^4/4 - f y_1 cos(omega t)).
// K and B depend on time, and so does the field. Nothing is conserved; the energy p^2/2 + a x^2/2 + b x^4/4
// changes at the rate f p cos(omega t) - nu p^2.
#include <pfaff/core/system.hpp>

#include "exponential_chart.hpp"

namespace {
using namespace pfaff;

struct DrivenDuffing : ExponentialChart<DrivenDuffing> {
  static constexpr int dimension = 2;
  Real nu = 0.25_r, a = -1, b = 1, f = 0.4_r, omega = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&DrivenDuffing::nu, "nu", "1/s", 0, 10, "damping rate"),
            parameter(&DrivenDuffing::a, "a", "1/s^2", -100, 100, "linear stiffness"),
            parameter(&DrivenDuffing::b, "b", "1/(m^2 s^2)", 0, 100, "cubic stiffness"),
            parameter(&DrivenDuffing::f, "f", "m/s^2", 0, 100, "amplitude of the force"),
            parameter(&DrivenDuffing::omega, "omega", "1/s", 0, 100, "angular frequency of the force")};
  }

  /// a x^2/2 + b x^4/4.
  template <class T>
  T potential_well(const T& x) const {
    const T square = x * x;
    return square * (2 * a + b * square) / 4;
  }
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return growth(t) *
           (z[1] * z[1] / 2 + nu * z[0] * z[1] / 2 + potential_well(z[0]) - f * z[0] * cos(omega * t));
  }
  template <class T>
  T chart_hamiltonian(const T& t, In<T> y) const {
    return decay(t) * (y[1] * y[1]) / 2 + growth(t) * (potential_well(y[0]) - f * y[0] * cos(omega * t));
  }
  template <class T>
  void chart_field(const T& t, In<T> y, Out<T> rate) const {
    const T factor = growth(t);
    rate[0] = y[1] / factor;
    rate[1] = factor * (f * cos(omega * t) - y[0] * (a + b * (y[0] * y[0])));
  }
  template <class T>
  void field(const T& t, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = f * cos(omega * t) - nu * z[1] - z[0] * (a + b * (z[0] * z[0]));
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[1] * z[1] / 2 + potential_well(z[0]);
  }
};

const System<DrivenDuffing> registered{
    {.name = "driven-duffing",
     .title = "Duffing's oscillator, x'' + nu x' + a x + b x^3 = f cos(omega t)",
     .reference = "duffing1918; holmes1979; su-qin (67)",
     .description = "A particle in a double well with friction and a periodic force, chaotic for suitable "
                    "parameters. Take it to test methods on a structure and a field that both depend on "
                    "time, where nothing at all is conserved. Chaotic motion forgets its initial state: "
                    "compare statistics or short times there, not end points.",
     .coordinates = {{"x", "m"}, {"p", "m/s"}},
     .initial = {1, 0.5_r},
     .invariants = {{"energy", "m^2/s^2", Behaviour::free}}}};
}  // namespace
