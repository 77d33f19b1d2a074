// A step along the mean of the gradients of the energy at its two ends:
//
//   z' = z + h Pi(m, s) (dH(z) + dH(z'))/2,  m = (z + z')/2,  s = t + h/2
//
// Source: the averaged vector field of Quispel, McLaren, J. Phys. A 41 (2008) 045206, by the trapezoidal
// rule.
//
// False: `energy` holds for quadratic energies only, as the trapezoidal rule is exact for linear gradients.
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

template <class P>
concept HasEnergy = HasVectorField<P> && requires(const P& p, const Scalar<P>& t, State<P>& z) {
  p.hamiltonian(t, z);
  p.poisson_tensor(t, z, z);
};

struct TrapezoidalGradient {
  static constexpr bool fixed_sizes = false;

  template <class P>
  struct Work {
    using T = Scalar<P>;
    Evaluator<T> slopes;  // dH
    std::vector<T> tensor;
    State<P> next, middle, start, gradient;
    Work(const TrapezoidalGradient& /*method*/, const P& p)
        : slopes(make_evaluator<T>(p.model(), Formula::hamiltonian_gradient)),
          tensor(p.size() * p.size()),
          next(p.make_state()),
          middle(p.make_state()),
          start(p.make_state()),
          gradient(p.make_state()) {}
  };

  template <HasEnergy P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    const std::size_t n = z.size();
    const T time = t + h / T(2);
    w.slopes.call(w.slopes.context, time, z.data(), w.start.data());
    for (std::size_t k = 0; k < n; ++k) w.next[k] = z[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < n; ++k) w.middle[k] = (z[k] + w.next[k]) / T(2);
      w.slopes.call(w.slopes.context, time, w.next.data(), w.gradient.data());
      p.poisson_tensor(time, w.middle, w.tensor);
      convergence.begin_iteration();
      for (std::size_t i = 0; i < n; ++i) {
        T change(0);
        for (std::size_t j = 0; j < n; ++j)
          change = change + w.tensor[i * n + j] * (w.start[j] + w.gradient[j]) / T(2);
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

const Method<TrapezoidalGradient> registered{
    {.name = "trapezoidal-gradient",
     .title = "averaged gradient by the trapezoidal rule, energy-preserving and symmetric",
     .reference = "quispel-mclaren2008",
     .description = "An implicit method that follows the averaged gradient of the energy. Take it where the "
                    "energy must not drift. It is not symplectic.",
     .order = 2,
     .preserves = {Claim::energy, Claim::symmetric}}};
}  // namespace
