// Parameters of which some have several values, and the grid that these span.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pfaff/core/registry/parameter.hpp>

namespace pfaff {

/// Parameters by name, each with the values that it takes in turn.
using AssignmentLists = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// One point of a grid.
struct GridPoint {
  Assignments values;   // of every parameter
  std::string varying;  // "nu = 0.1, order = 4": those with several values; empty where there are none
};

/// All points of the grid, the values of the last parameter changing first. One point without parameters
/// where there are none.
std::vector<GridPoint> points_of(const AssignmentLists& lists);

}  // namespace pfaff
