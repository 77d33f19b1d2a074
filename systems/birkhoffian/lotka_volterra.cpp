// The predator-prey model of Lotka and Volterra, x' = x (alpha - beta y), y' = y (delta x - gamma), z = (x,
// y).
//
//   V = delta x - gamma log x + beta y - alpha log y is conserved, and z' = x y (-V_y, V_x):
//   F = (-(log y)/(2 x), (log x)/(2 y)),   B = V,   K = [[0, 1], [-1, 0]]/(x y)
//
// Darboux chart (log y, log x) =: (q, p), in this order for the sign of K. There the Hamiltonian is V again,
// H = delta e^p - gamma p + beta e^q - alpha q. Populations are positive: F, B, the chart and V are NaN
// elsewhere, which the methods that use them report.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct LotkaVolterra {
  static constexpr int dimension = 2;
  Real alpha = 1, beta = 1, gamma = 2, delta = 1;
  static std::vector<Parameter> parameters() {
    return {parameter(&LotkaVolterra::alpha, "alpha", "1/s", 1e-3, 1e3, "growth rate of the prey"),
            parameter(&LotkaVolterra::beta, "beta", "1/s", 1e-3, 1e3, "loss of prey for each predator"),
            parameter(&LotkaVolterra::gamma, "gamma", "1/s", 1e-3, 1e3, "death rate of the predators"),
            parameter(&LotkaVolterra::delta, "delta", "1/s", 1e-3, 1e3, "gain of predators for each prey")};
  }

  template <class T>
  T birkhoffian(const T& /*t*/, In<T> z) const {
    return delta * z[0] - gamma * log(z[0]) + beta * z[1] - alpha * log(z[1]);
  }
  template <class T>
  void one_form(const T& /*t*/, In<T> z, Out<T> form) const {
    form[0] = -(log(z[1]) / (2 * z[0]));
    form[1] = log(z[0]) / (2 * z[1]);
  }
  template <class T>
  void chart(const T& /*t*/, In<T> z, Out<T> y) const {
    y[0] = log(z[1]);
    y[1] = log(z[0]);
  }
  template <class T>
  void chart_inverse(const T& /*t*/, In<T> y, Out<T> z) const {
    z[0] = exp(y[1]);
    z[1] = exp(y[0]);
  }
  template <class T>
  T chart_hamiltonian(const T& /*t*/, In<T> y) const {
    return delta * exp(y[1]) - gamma * y[1] + beta * exp(y[0]) - alpha * y[0];
  }
  template <class T>
  void chart_field(const T& /*t*/, In<T> y, Out<T> rate) const {
    rate[0] = delta * exp(y[1]) - gamma;
    rate[1] = alpha - beta * exp(y[0]);
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    rate[0] = z[0] * (alpha - beta * z[1]);
    rate[1] = z[1] * (delta * z[0] - gamma);
  }
  template <class T>
  void invariants(const T& t, In<T> z, Out<T> values) const {
    values[0] = birkhoffian(t, z);
  }
};

const System<LotkaVolterra> registered{
    {.name = "lotka-volterra",
     .title = "predator and prey, x' = x (alpha - beta y), y' = y (delta x - gamma)",
     .reference = "hairer-lubich-wanner2006 (I.1.1)-(I.1.4)",
     .description = "Predator and prey, a Poisson system whose structure depends on the state. Take it to "
                    "compare methods on closed orbits in the plane with a conserved quantity that is not "
                    "quadratic; in logarithms of the populations the structure is canonical. Populations are "
                    "positive, and steps that leave the quadrant are reported as not finite.",
     .coordinates = {{"x", ""}, {"y", ""}},
     .initial = {3, 1},
     .invariants = {conserved("V", "1/s")}}};
}  // namespace
