// The linear damped oscillator r'' + nu r' + r = 0 in Birkhoff's form, z = (r, p), p = r' (su-qin (92)-(95),
// with the middle term of B corrected, docs/errata.md).
//
//   F = e^{nu t} (p/2, -r/2),   B = e^{nu t} (r^2 + nu r p + p^2)/2,   K = e^{nu t} [[0, -1], [1, 0]]
//
// B is conserved along solutions. Darboux chart y = (r, e^{nu t} p). The equation is linear and hides errors
// of a method that nonlinear equations show, so that orders are verified on the damped pendulum as well.
#include <pfaff/core/system.hpp>

#include "exponential_chart.hpp"

namespace {
using namespace pfaff;

struct DampedOscillator : ExponentialChart<DampedOscillator> {
  static constexpr int dimension = 2;
  Real nu = 0.3_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&DampedOscillator::nu, "nu", "1/s", 0, 10, "damping rate")};
  }
  // Damping of each kind, whose exact solutions are different formulas.
  static std::vector<Assignments> instances(bool /*full*/) { return {{}, {{"nu", "2"}}, {{"nu", "3"}}}; }

  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return growth(t) * (z[0] * z[0] + nu * z[0] * z[1] + z[1] * z[1]) / 2;
  }
  template <class T>
  T chart_hamiltonian(const T& t, In<T> y) const {
    return (decay(t) * (y[1] * y[1]) + growth(t) * (y[0] * y[0])) / 2;
  }
  template <class T>
  void chart_field(const T& t, In<T> y, Out<T> rate) const {
    const T factor = growth(t);
    rate[0] = y[1] / factor;
    rate[1] = -(factor * y[0]);
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -(nu * z[1]) - z[0];
  }
  // Friction on (q, p) = (r, p): the mechanical energy and its rate of damping.
  [[nodiscard]] Real damping() const { return nu; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return q[0] * q[0] / 2;
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = birkhoffian(t, z);
    values[1] = (z[0] * z[0] + z[1] * z[1]) / 2;
  }
  // r = r0 C + (p0 + nu r0/2) S with C = e^{-nu s/2} cos w s, S = e^{-nu s/2} sin(w s)/w, w = sqrt(1 -
  // nu^2/4); hyperbolic functions when overdamped, C = e^{-s} and S = s e^{-s} when critical.
  template <class T>
  void exact_solution(const T& s, const T& /*t0*/, In<T> z0, Out<T> z) const {
    const Real square = Real(1) - nu * nu / Real(4);
    const T decay = exp(-(nu * s) / 2);
    T c = decay, sine = decay * s;
    if (square > Real(0)) {
      const Real w = sqrt(square);
      c = decay * cos(w * s);
      sine = decay * sin(w * s) / w;
    } else if (square < Real(0)) {
      // The rates w - nu/2 = -1/(w + nu/2) and -(w + nu/2), without overflow and cancellation; sinh x from
      // its series where x < 1.
      const Real w = sqrt(-square), rate = w + nu / 2;
      const T slow = exp(-(s / rate)), fast = exp(-(rate * s)), x2 = w * s * (w * s);
      T series(1);
      for (int k = 16; k > 0; --k) series = 1 + series * x2 / (2 * k * (2 * k + 1));
      c = (slow + fast) / 2;
      sine = select(1 - x2, decay * s * series, (slow - fast) / (2 * w));
    }
    const T b = z0[1] + nu * z0[0] / 2;
    z[0] = z0[0] * c + b * sine;
    z[1] = b * c - square * z0[0] * sine - nu * z[0] / 2;
  }
};

const System<DampedOscillator> registered{
    {.name = "damped-oscillator",
     .title = "damped oscillator in Birkhoff's form, r'' + nu r' + r = 0",
     .reference = "su-qin (92)-(95)",
     .description = "The linear damped oscillator in Birkhoff's form, with an exact solution and a conserved "
                    "Birkhoffian although the energy decays. Take it to compare schemes that keep the "
                    "time-dependent structure with those that do not, step by step against closed forms. It "
                    "is linear and so hides errors of order; the damped pendulum does not.",
     .coordinates = {{"r", "m"}, {"p", "m/s"}},
     .initial = {1, 0},
     .invariants = {conserved("birkhoffian", "m^2/s^2"), decreasing("energy", "m^2/s^2")}}};
}  // namespace
