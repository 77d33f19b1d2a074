// An integration that shares nothing with the closed forms it is compared with: Taylor steps in quad on the
// tape of a field.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/series.hpp>

namespace pfaff::testing {

/// The solution of z' = X(z, t) through z at time t, `elapsed` later, to about 1e-32 for each unit of |X|
/// time: series of 41 terms, steps of a tenth of the radius of convergence that the last terms show.
inline std::vector<Quad> taylor_flow(const std::shared_ptr<const Tape>& field, Quad t, std::vector<Quad> z,
                                     Quad elapsed) {
  constexpr std::size_t order = 40;
  const std::size_t n = z.size();
  SeriesReplay<Quad> series(field, order, 1);
  std::vector<Quad> x((order + 1) * n);
  const Quad one(1), sign(elapsed < Quad(0) ? -1 : 1), end = abs(elapsed);
  for (Quad done(0); done < end;) {
    const Quad now = t + sign * done;
    series.set_time(&now, &one);
    std::copy(z.begin(), z.end(), x.begin());
    for (std::size_t l = 0; l < order; ++l) {
      series.set_input(l, x.data() + l * n);
      series.advance(l);
      for (std::size_t k = 0; k < n; ++k)
        x[(l + 1) * n + k] = *series.output(k, l) / Quad(static_cast<int>(l + 1));
    }
    Quad size(0), last(0);
    for (std::size_t k = 0; k < n; ++k) size = std::max(size, abs(z[k]));
    // The highest pair of degrees that does not vanish, of the last ten: some series have gaps.
    std::size_t degree = order + 2;
    while (last == Quad(0) && degree > order - 8) {
      degree -= 2;
      for (std::size_t k = 0; k < n; ++k)
        last = std::max({last, abs(x[degree * n + k]), abs(x[(degree - 1) * n + k])});
    }
    Quad step = end - done;
    if (last > Quad(0))
      step = std::min(step, exp(log(size / last) / Quad(static_cast<int>(degree))) / Quad(10));
    for (std::size_t k = 0; k < n; ++k) {
      z[k] = Quad(0);
      for (std::size_t l = order + 1; l-- > 0;) z[k] = z[k] * (sign * step) + x[l * n + k];
    }
    done += step;
  }
  return z;
}
/// The same along the field of a model, from time 0 on.
inline std::vector<Quad> taylor_flow(const std::shared_ptr<const Model>& motion, const std::vector<Quad>& z,
                                     Quad elapsed) {
  return taylor_flow(motion->tape(Formula::field), Quad(0), z, elapsed);
}
/// How near to the solution that is over a few units of time: errors grow with the motion.
inline constexpr double taylor_tolerance = 1e-29;

}  // namespace pfaff::testing
