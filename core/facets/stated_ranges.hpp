// The ranges that coordinates state, of systems and of brackets.
#pragma once

#include <algorithm>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The range of each coordinate; empty where none of them states one.
inline std::vector<Range> stated_ranges(const std::vector<Coordinate>& coordinates) {
  std::vector<Range> ranges;
  for (const Coordinate& c : coordinates) ranges.push_back(c.range);
  const bool any = std::any_of(ranges.begin(), ranges.end(), [](const Range& r) { return r != unbounded; });
  if (!any) ranges.clear();
  return ranges;
}

}  // namespace pfaff
