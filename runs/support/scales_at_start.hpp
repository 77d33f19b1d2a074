// The scales of coordinates over the first steps of a run, for states that a measure puts beside its start.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <pfaff/runs/measure.hpp>
#include <pfaff/runs/support/scales.hpp>

namespace pfaff {

/// The scales of the coordinates of a measured run at its start and over its first steps, which show the
/// sizes of coordinates that start at zero.
template <class T>
std::vector<double> scales_at_start(const Measured<T>& run) {
  constexpr std::int64_t most = 32;
  Integration<T> first = run.start.beside({run.start.state().begin(), run.start.state().end()});
  std::vector<double> sizes(run.start.state().size());
  std::int64_t taken = 0;
  do {
    for (std::size_t k = 0; k < sizes.size(); ++k)
      sizes[k] = std::max(sizes[k], std::abs(static_cast<double>(first.state()[k])));
  } while (taken++ < std::min(run.steps, most) && first.steps(1).reached());
  return scales_of(sizes);
}

}  // namespace pfaff
