// The scales of coordinates where a run starts, for states that a measure puts beside its start.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/scales.hpp>

namespace pfaff {

/// The scales of the coordinates of a measured run at its start and behind its first step, which shows the
/// sizes of coordinates that start at zero.
template <class T>
std::vector<double> scales_at_start(const Measured<T>& run) {
  Integration<T> first = run.start.beside({run.start.state().begin(), run.start.state().end()});
  std::vector<double> sizes(run.start.state().size());
  const auto take = [&] {
    for (std::size_t k = 0; k < sizes.size(); ++k)
      sizes[k] = std::max(sizes[k], std::abs(static_cast<double>(first.state()[k])));
  };
  take();
  if (first.steps(1).reached()) take();
  return scales_of(sizes);
}

/// The norm of the start in these scales; 1 where the run starts at the origin.
template <class T>
T size_at_start(const Measured<T>& run, const std::vector<double>& scales) {
  const T norm = scaled_norm<T>(run.start.state(), scales);
  return norm > T(0) ? norm : T(1);
}

}  // namespace pfaff
