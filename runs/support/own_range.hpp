// own_range: how much of a conserved quantity there is to lose.
//
// A quantity I is lost when it has moved by its distance |I(0) - I*| from the equilibrium I*, the minimum or
// the maximum that steps downhill or uphill from the first state come to: a pendulum whose energy has fallen
// to that of rest has nothing left, whatever constant its potential energy contains. Kepler's energy, momenta
// and other quantities without an equilibrium are lost when they have moved by |I(0)|. Neither has to do with
// the sum of the magnitudes of the terms, which is several times as large where they cancel, or where there
// is a rest energy.
#pragma once

#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// Where a run begins, in double.
struct StartOfMotion {
  double t = 0;
  std::vector<double> z;
  /// Of the coordinates: the largest size early in the motion, in which steps to the equilibrium are
  /// measured. A coordinate whose extent is 0 is held.
  std::vector<double> extents;
  std::vector<double> values, terms;  // of the invariants: I(0), and the sum of the magnitudes of its terms
};

/// The range of every invariant of the model, to some per cent: |I(0) - I*|, or |I(0)| where no equilibrium
/// is found, which is not looked for on surfaces of constraints. Where that is zero but for roundings, the
/// sum of the terms.
std::vector<double> own_ranges(const Model& model, const StartOfMotion& start);

}  // namespace pfaff
