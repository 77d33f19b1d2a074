#include <pfaff/runs/support/plane.hpp>

#include <algorithm>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

std::optional<Plane> plane_of(const Model& model) {
  const std::vector<Coordinate>& all = model.coordinates();
  if (all.size() < 2) return std::nullopt;
  if (all.size() == 2) return Plane(0, 1);
  const std::size_t positions = all.size() % 2 == 0 ? all.size() / 2 : all.size();
  for (std::size_t i = 0; i < positions; ++i)
    for (std::size_t j = i + 1; j < positions; ++j)
      if (all[i].unit == all[j].unit) return Plane(i, j);
  return Plane(0, 1);
}

Plane plane_of(const Model& model, const std::string& x, const std::string& y) {
  if (x.empty() && y.empty()) return plane_of(model).value();
  std::vector<std::string> names;
  for (const Coordinate& c : model.coordinates()) names.push_back(c.name);
  const auto number = [&](const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw InputError(unknown_name("coordinate", name, names));
    return static_cast<std::size_t>(found - names.begin());
  };
  return {number(x), number(y)};
}

}  // namespace pfaff
