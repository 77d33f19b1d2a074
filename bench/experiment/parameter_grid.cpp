#include <pfaff/bench/experiment/parameter_grid.hpp>

namespace pfaff {

std::vector<GridPoint> points_of(const AssignmentLists& lists) {
  std::vector<GridPoint> points(1);
  for (const auto& [name, values] : lists) {
    std::vector<GridPoint> longer;
    for (const GridPoint& point : points)
      for (const std::string& value : values) {
        GridPoint& next = longer.emplace_back(point);
        next.values.emplace_back(name, value);
        if (values.size() == 1) continue;
        next.varying += next.varying.empty() ? "" : ", ";
        next.varying += name;
        next.varying += " = ";
        next.varying += value;
      }
    points = std::move(longer);
  }
  return points;
}

}  // namespace pfaff
