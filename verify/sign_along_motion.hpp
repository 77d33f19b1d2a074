// The sign of a rate along a motion. A rate that has the right sign at random states may have the wrong one
// in a thin layer of states, which a motion crosses.
#pragma once

#include <memory>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/tape.hpp>
#include <pfaff/verify/residuals.hpp>

namespace pfaff {

/// The largest value that the one output of a tape takes along the motion from the first centre of its
/// region, relative to the rounding of its terms, and zero where it is never positive. It is looked at at
/// some hundred times, over as long as region_of follows the motion, and its highest maxima between these are
/// searched for. The motion has to be is_short.
double largest_along(const std::shared_ptr<const Model>& motion, const std::shared_ptr<const Tape>& rate,
                     const Region& region);

}  // namespace pfaff
