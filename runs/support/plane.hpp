// The plane in which a motion is drawn where nobody names one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The numbers of two coordinates: q and p where these are all there are, otherwise the first two of the
/// positions (of all coordinates where their number is odd) that have one unit, and the first two coordinates
/// where no two have. Empty for a system of fewer than two coordinates.
std::optional<std::pair<std::size_t, std::size_t>> plane_of(const Model& model);

/// Those of the coordinates `x` and `y`, or the above where both are empty, of a system that has two.
/// InputError where one is none, with the nearest.
std::pair<std::size_t, std::size_t> plane_of(const Model& model, const std::string& x, const std::string& y);

}  // namespace pfaff
