// The averaged vector field z' = z + h int X(z + s (z' - z)) ds over 0 < s < 1 of canonical systems.
//
// Source: Quispel, McLaren 2008, (7).
//
// False: `energy`, whatever its degree, is kept for polynomials of degree 10 at most: the integral is a sum
// over five of Gauss's points, and other energies are off by h^11.
#include <string>
#include <vector>

#include <pfaff/core/integrator.hpp>
#include <pfaff/core/numbers/gauss_legendre.hpp>
#include <pfaff/core/solve/convergence.hpp>

namespace {
using namespace pfaff;

struct AveragedField {
  static constexpr bool fixed_sizes = false;

  [[nodiscard]] std::string refuses(const Model& model) const {
    return model.canonical() ? "" : "averages the field and needs a canonical system";
  }

  template <class P>
  struct Work {
    State<P> next, point, rate, mean;
    std::vector<Scalar<P>> places, weights;
    Work(const AveragedField& /*method*/, const P& p)
        : next(p.make_state()), point(p.make_state()), rate(p.make_state()), mean(p.make_state()) {
      for (const QuadratureNode& node : gauss_legendre(5)) {
        places.emplace_back(node.place);
        weights.emplace_back(node.weight);
      }
    }
  };

  template <HasVectorField P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    using T = Scalar<P>;
    p.field(t, z, w.rate);
    for (std::size_t k = 0; k < z.size(); ++k) w.next[k] = z[k] + h * w.rate[k];
    Convergence<T> convergence(Corrections::uneven);
    do {
      for (std::size_t k = 0; k < z.size(); ++k) w.mean[k] = T(0);
      for (std::size_t i = 0; i < w.places.size(); ++i) {
        for (std::size_t k = 0; k < z.size(); ++k) w.point[k] = z[k] + w.places[i] * (w.next[k] - z[k]);
        p.field(t + h / T(2), w.point, w.rate);
        for (std::size_t k = 0; k < z.size(); ++k) w.mean[k] = w.mean[k] + w.weights[i] * w.rate[k];
      }
      convergence.begin_iteration();
      for (std::size_t k = 0; k < z.size(); ++k) {
        const T corrected = z[k] + h * w.mean[k];
        convergence.add(corrected - w.next[k], z[k], corrected);
        w.next[k] = corrected;
      }
    } while (!convergence.finished(200));
    if (convergence.status() != Status::converged) return convergence.status();
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = w.next[k];
    return Status::converged;
  }
};

const Method<AveragedField> registered{
    {.name = "averaged-field",
     .title = "averaged vector field",
     .reference = "quispel-mclaren2008 (7)",
     .description = "The averaged vector field of canonical systems, by functional iteration. Take it where "
                    "energies matter more than the structure. Steps must be short enough for the iteration.",
     .order = 2,
     .preserves = {Claim::energy, Claim::symmetric}}};
}  // namespace
