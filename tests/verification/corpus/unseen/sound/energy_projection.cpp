// A step of the classical method of Runge and Kutta, of order 4, and then a projection onto the surface of
// the energy at which the step began, along the gradient of H at the end of the step: z' = z* + s dH(z*) with
// H(z') = H(z). Any energy is kept; nothing else is.
//
// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, IV.4, algorithm 4.2.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

template <class P>
concept HasEnergy = HasVectorField<P> && requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.hamiltonian(t, z);
};

struct EnergyProjection {
  static constexpr bool fixed_sizes = false;

  [[nodiscard]] std::string refuses(const Model& model) const {
    return model.autonomous() && !model.restricted()
               ? ""
               : "needs an energy that does not depend on time, without constraints";
  }

  template <class P>
  struct Work {
    using T = Scalar<P>;
    Evaluator<T> slopes;  // dH
    State<P> rate, point, next, gradient, found;
    Work(const EnergyProjection& /*method*/, const P& p)
        : slopes(make_evaluator<T>(p.model(), Formula::hamiltonian_gradient)),
          rate(p.make_state()),
          point(p.make_state()),
          next(p.make_state()),
          gradient(p.make_state()),
          found(p.make_state()) {}
  };

  template <HasEnergy P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    const T energy = p.hamiltonian(t, z);
    p.field(t, z, w.rate);
    for (std::size_t k = 0; k < n; ++k) w.next[k] = z[k];
    gather(z, h / T(2), h / T(6), w);
    p.field(t + h / T(2), w.point, w.rate);
    gather(z, h / T(2), h / T(3), w);
    p.field(t + h / T(2), w.point, w.rate);
    gather(z, h, h / T(3), w);
    p.field(t + h, w.point, w.rate);
    gather(z, h, h / T(6), w);

    w.slopes.call(w.slopes.context, t, w.next.data(), w.gradient.data());
    T square(0), length(0);
    for (std::size_t k = 0; k < n; ++k) square = square + w.gradient[k] * w.gradient[k];
    for (std::size_t k = 0; k < n; ++k) w.found[k] = w.next[k];
    if (!(value_of(square) > Value<T>(0))) {  // at rest
      for (std::size_t k = 0; k < n; ++k) z[k] = w.next[k];
      return Status::converged;
    }
    Convergence<T> convergence;
    do {
      const T correction = (p.hamiltonian(t, w.found) - energy) / square;
      length = length - correction;
      convergence.begin_iteration();
      for (std::size_t k = 0; k < n; ++k) {
        convergence.add(correction * w.gradient[k], w.next[k], w.next[k] - z[k]);
        w.found[k] = w.next[k] + length * w.gradient[k];
      }
    } while (!convergence.finished(100));
    if (convergence.status() == Status::converged)
      for (std::size_t k = 0; k < n; ++k) z[k] = w.found[k];
    return convergence.status();
  }

 private:
  template <class P>
  static void gather(const State<P>& z, const Scalar<P>& reach, const Scalar<P>& weight, Work<P>& w) {
    for (std::size_t k = 0; k < z.size(); ++k) {
      w.point[k] = z[k] + reach * w.rate[k];
      w.next[k] = w.next[k] + weight * w.rate[k];
    }
  }
};

const Method<EnergyProjection> registered{
    {.name = "energy-projection",
     .title = "classical Runge-Kutta method, each step projected onto the surface of the energy",
     .reference = "hairer-lubich-wanner2006 IV.4",
     .description = "The classical method of order 4 with a projection after each step, which keeps any "
                    "energy. It is neither "
                    "symplectic nor symmetric.",
     .order = 4,
     .preserves = {Claim::energy}}};
}  // namespace
