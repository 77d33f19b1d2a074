// The plane in which a motion is drawn where nobody names one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The numbers of two coordinates.
using Plane = std::pair<std::size_t, std::size_t>;

/// The plane of q and p where these are all there are, otherwise of the first two of the
/// positions (of all coordinates where their number is odd) that have one unit, and of the first two
/// coordinates where no two have. Empty for a system of fewer than two coordinates.
std::optional<Plane> plane_of(const Model& model);

/// Those of the coordinates `x` and `y`, or the above where both are empty, of a system that has two.
/// InputError where one is none, with the nearest.
Plane plane_of(const Model& model, const std::string& x, const std::string& y);

}  // namespace pfaff
