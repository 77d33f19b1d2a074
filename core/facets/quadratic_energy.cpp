#include <pfaff/core/facets/quadratic_energy.hpp>

#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

// v(a) + v(b) - v(a + b) - v(0) vanishes where v is linear up to a constant. Quad tells a little curvature
// from round-off.
bool quadratic_in_momenta(const Model& model) {
  Replay<Quad> gradient(model.tape(Formula::hamiltonian_gradient));
  const auto n = static_cast<std::size_t>(model.dimension()) / 2;
  std::vector<Quad> z(2 * n), slopes(2 * n);
  for (std::size_t k = 0; k < n; ++k)
    z[k] = model.initial().size() == 2 * n ? model.initial()[k].quad() : Quad(1);
  for (const double time : {0.0, 0.625})
    for (const double scale : {1.0, 1024.0, 1048576.0}) {
      std::vector<Quad> sum(n);
      Quad largest(0), difference(0);
      for (const int part : {0, 1, 2, 3}) {
        for (std::size_t k = 0; k < n; ++k) {
          const double a = scale * (1 + static_cast<double>(k % 7) / 8),
                       b = scale * (static_cast<double>(k % 5) / 4 - 0.5);
          z[n + k] = Quad((part == 0 || part == 2 ? a : 0) + (part == 1 || part == 2 ? b : 0));
        }
        gradient(Quad(time), z.data(), slopes.data());
        for (std::size_t k = 0; k < n; ++k) {
          sum[k] += part < 2 ? slopes[n + k] : -slopes[n + k];
          if (abs(slopes[n + k]) > largest) largest = abs(slopes[n + k]);
        }
      }
      for (const Quad& x : sum)
        if (!(abs(x) <= difference)) difference = abs(x);
      if (!(difference <= Quad(1024) * unit_roundoff<Quad>() * largest)) return false;
    }
  return true;
}

bool steady_kinetic_energy(const Model& model) { return model.tape(Formula::velocity)->autonomous(); }

}  // namespace pfaff
