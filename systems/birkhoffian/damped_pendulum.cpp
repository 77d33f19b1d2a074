// The damped pendulum r'' + nu r' + sin r = 0 in Birkhoff's form, z = (r, p), p = r' (after su-qin (92)-(94)
// with sin r for r).
//
//   F = e^{nu t} (p/2, -r/2),   B = e^{nu t} (p^2/2 + nu r p/2 - cos r),   K = e^{nu t} [[0, -1], [1, 0]]
//
// Darboux chart y = (r, e^{nu t} p), where the Hamiltonian is H = e^{-nu t} y_2^2/2 - e^{nu t} cos y_1. The
// flow keeps K(z, t); the mechanical energy p^2/2 - cos r decreases at the rate nu p^2.
//
// For schemes without the chart: alpha is (95), w^ = (R^, P^) and w = (R, P), followed by the nonlinear
// w -> w + grad g(w^), g = R^ P^^2/2.
#include <pfaff/core/system.hpp>

#include "exponential_chart.hpp"

namespace {
using namespace pfaff;

struct DampedPendulum : ExponentialChart<DampedPendulum> {
  static constexpr int dimension = 2;
  Real nu = 0.3_r;
  static std::vector<Parameter> parameters() {
    return {parameter(&DampedPendulum::nu, "nu", "1/s", 0, 10, "damping rate")};
  }
  static std::vector<Assignments> instances(bool /*full*/) { return {{}, {{"nu", "0"}}, {{"nu", "4"}}}; }

  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return growth(t) * (z[1] * z[1] / 2 + nu * z[0] * z[1] / 2 - cos(z[0]));
  }
  template <class T>
  T chart_hamiltonian(const T& t, In<T> y) const {
    return decay(t) * (y[1] * y[1]) / 2 - growth(t) * cos(y[0]);
  }
  template <class T>
  void chart_field(const T& t, In<T> y, Out<T> rate) const {
    const T factor = growth(t);
    rate[0] = y[1] / factor;
    rate[1] = -(factor * sin(y[0]));
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[1];
    rate[1] = -(nu * z[1]) - sin(z[0]);
  }
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const T new_p = growth(t) * new_z[1], old_p = growth(t0) * old_z[1];
    w_hat[0] = new_p - old_p;
    w_hat[1] = new_z[0] - old_z[0];
    w[0] = (new_z[0] + old_z[0] + w_hat[1] * w_hat[1]) / 2;
    w[1] = w_hat[0] * w_hat[1] - (new_p + old_p) / 2;
  }
  // Friction on (q, p) = (r, p): the mechanical energy and its rate of damping.
  [[nodiscard]] Real damping() const { return nu; }
  template <class T>
  T kinetic(const T& /*t*/, In<T> p) const {
    return p[0] * p[0] / 2;
  }
  template <class T>
  T potential(const T& /*t*/, In<T> q) const {
    return -cos(q[0]);
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = z[1] * z[1] / 2 - cos(z[0]);
  }
};

const System<DampedPendulum> registered{
    {.name = "damped-pendulum",
     .title = "damped pendulum in Birkhoff's form, r'' + nu r' + sin r = 0",
     .reference = "su-qin (92)-(95)",
     .description = "The pendulum with linear friction in Birkhoff's form, with a Darboux chart and an alpha "
                    "that is not a chart's. Take it as the nonlinear test of K(z, t)-symplectic methods, "
                    "whose orders and structure are verified on it. The structure grows as e^{nu t}, so that "
                    "chart momenta overflow in double precision beyond nu t of about 700.",
     .coordinates = {{"r", "rad"}, {"p", "rad/s"}},
     .initial = {1, 0.5_r},
     .invariants = {decreasing("energy", "rad^2/s^2")}}};
}  // namespace
