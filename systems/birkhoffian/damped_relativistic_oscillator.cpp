// A relativistic particle with linear friction on a hardening spring, in its position and velocity, z = (q,
// v), the speed of light being 1: with c = (1 - v^2)^{-1/2},
//
//   q' = v,   (c v)' = -nu c v - q - k q^3
//   F = e^{nu t} (c v, 0),   B = e^{nu t} (c + q^2/2 + k q^4/4),   K = e^{nu t} c^3 [[0, -1], [1, 0]]
//
// K depends on the state and on time. Instead of a chart the system writes a transformation alpha of pairs of
// states (su-qin (34)) that is not a chart's: with p = e^{nu t} c v, primes for the new state,
//
//   w^ = (p' - p, q - q'),   w = ((q + q')/2 + b w^_1^2, (p + p')/2 + b w^_2^2):
//
// the Poincare form followed by w -> w + grad g(w^), g = b (w^_1^3 + w^_2^3)/3, which keeps w^.dw up to an
// exact form. It exchanges old and new as the Poincare form does, w^ odd and w even. Without friction
// c + q^2/2 + k q^4/4 is conserved, with friction it decreases at the rate nu c v^2. Speeds are below 1: F, B
// and alpha are NaN elsewhere, which the methods that use them report.
#include <pfaff/core/system.hpp>

namespace {
using namespace pfaff;

struct DampedRelativisticOscillator {
  static constexpr int dimension = 2;
  Real nu = 0.3_r, k = 1, b = 0.5_r;
  static std::vector<Parameter> parameters() {
    using S = DampedRelativisticOscillator;
    return {parameter(&S::nu, "nu", "1", 0, 10, "damping rate"),
            parameter(&S::k, "k", "1", 0, 100, "hardening of the spring"),
            parameter(&S::b, "b", "1", -10, 10, "how far alpha bends w; 0 gives the Poincare form")};
  }

  template <class T>
  T lorentz_factor(In<T> z) const {
    return 1 / sqrt(1 - z[1] * z[1]);
  }
  template <class T>
  T energy(In<T> z) const {
    const T square = z[0] * z[0];
    return lorentz_factor<T>(z) + square / 2 + k * (square * square) / 4;
  }
  template <class T>
  T birkhoffian(const T& t, In<T> z) const {
    return exp(nu * t) * energy<T>(z);
  }
  template <class T>
  void one_form(const T& t, In<T> z, Out<T> form) const {
    form[0] = exp(nu * t) * lorentz_factor<T>(z) * z[1];
    form[1] = T(0);
  }
  template <class T>
  void alpha(const T& t, const T& t0, In<T> new_z, In<T> old_z, Out<T> w_hat, Out<T> w) const {
    const T new_p = exp(nu * t) * lorentz_factor<T>(new_z) * new_z[1];
    const T old_p = exp(nu * t0) * lorentz_factor<T>(old_z) * old_z[1];
    w_hat[0] = new_p - old_p;
    w_hat[1] = old_z[0] - new_z[0];
    w[0] = (new_z[0] + old_z[0]) / 2 + b * (w_hat[0] * w_hat[0]);
    w[1] = (new_p + old_p) / 2 + b * (w_hat[1] * w_hat[1]);
  }
  template <class T>
  void field(const T& /*t*/, In<T> z, Out<T> rate) const {
    const T rest = 1 - z[1] * z[1];
    rate[0] = z[1];
    rate[1] = -(rest * (nu * z[1] + sqrt(rest) * (z[0] + k * (z[0] * z[0] * z[0]))));
  }
  template <class T>
  void invariants(const T& /*t*/, In<T> z, Out<T> values) const {
    values[0] = energy<T>(z);
  }
};

const System<DampedRelativisticOscillator> registered{
    {.name = "damped-relativistic-oscillator",
     .title = "relativistic particle with friction on a spring, (c v)' = -nu c v - q - k q^3",
     .reference = "bateman1931; su-qin (34), (67)",
     .description = "A relativistic particle with friction on a hardening spring, in position and velocity. "
                    "Its structure depends on the state and on time, and it brings a transformation alpha of "
                    "pairs of states instead of a Darboux chart: take it to test schemes that work through "
                    "alpha alone. Speeds stay below 1; a state beyond has no number.",
     .coordinates = {{"q", "1"}, {"v", "1"}},
     .initial = {0.5_r, 0.4_r},
     .invariants = {decreasing("energy", "1")},
     .time_unit = "1"}};
}  // namespace
