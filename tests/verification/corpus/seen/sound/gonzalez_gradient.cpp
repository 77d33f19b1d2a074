// Gonzalez's discrete gradient: an implicit step of order 2 that keeps the energy of any autonomous
// Hamiltonian system, with the middle m, the change d and the time s = t + h/2:
//
//   z' = z + h Pi(m, s) (dH(m) + (H(z') - H(z) - dH(m).d) d/|d|^2)
//
// Source: Gonzalez, J. Nonlinear Sci. 6 (1996) 449; Hairer, Lubich, Wanner, Geometric Numerical
// Integration, V.5.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

template <class P>
concept HasEnergy = HasVectorField<P> && requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.hamiltonian(t, z);
  p.poisson_tensor(t, z, z);
};

struct GonzalezGradient {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    Evaluator<T> slopes;  // dH
    std::vector<T> tensor;
    State<P> next, middle, gradient;
    Work(const GonzalezGradient& /*method*/, const P& p)
        : slopes(make_evaluator<T>(p.model(), Formula::hamiltonian_gradient)),
          tensor(p.size() * p.size()),
          next(p.make_state()),
          middle(p.make_state()),
          gradient(p.make_state()) {}
  };

  template <HasEnergy P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    const T time = t + h / T(2), start = p.hamiltonian(time, z);
    p.field(time, z, w.next);
    for (std::size_t k = 0; k < n; ++k) w.next[k] = z[k] + h * w.next[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < n; ++k) w.middle[k] = (z[k] + w.next[k]) / T(2);
      w.slopes.call(w.slopes.context, time, w.middle.data(), w.gradient.data());
      p.poisson_tensor(time, w.middle, w.tensor);
      T missing = p.hamiltonian(time, w.next) - start, length(0);
      for (std::size_t k = 0; k < n; ++k) {
        const T d = w.next[k] - z[k];
        missing = missing - w.gradient[k] * d;
        length = length + d * d;
      }
      if (value_of(length) > Value<T>(0))
        for (std::size_t k = 0; k < n; ++k)
          w.gradient[k] = w.gradient[k] + missing * (w.next[k] - z[k]) / length;
      convergence.begin_iteration();
      for (std::size_t i = 0; i < n; ++i) {
        T change(0);
        for (std::size_t j = 0; j < n; ++j) change = change + w.tensor[i * n + j] * w.gradient[j];
        const T corrected = z[i] + h * change;
        convergence.add(corrected - w.next[i], z[i], corrected);
        w.next[i] = corrected;
      }
    } while (!convergence.finished(200));
    if (convergence.status() == Status::converged)
      for (std::size_t k = 0; k < n; ++k) z[k] = w.next[k];
    return convergence.status();
  }
};

const Method<GonzalezGradient> registered{
    {.name = "gonzalez-gradient",
     .title = "Gonzalez's discrete gradient, energy-preserving and symmetric",
     .reference = "gonzalez1996",
     .description = "An implicit method that keeps any energy, whatever its degree. Take it where the energy "
                    "must not drift. It is not symplectic.",
     .order = 2,
     .preserves = {Claim::energy, Claim::symmetric}}};
}  // namespace
