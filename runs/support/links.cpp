#include <pfaff/runs/support/links.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace pfaff {

namespace {

constexpr std::size_t most_points = 1000;

// Coordinates of each point, 2 or 3, where all positions are coordinates of points; otherwise 0.
std::size_t dimension_of_points(const Model& model, std::size_t degrees) {
  const std::vector<Coordinate>& names = model.coordinates();
  const std::string axes = "xyz";
  for (const std::size_t d : {std::size_t{3}, std::size_t{2}}) {
    if (degrees % d != 0 || degrees / d > most_points) continue;
    bool all = true;
    for (std::size_t k = 0; all && k < degrees; ++k)
      all = names[k].name == axes[k % d] + std::to_string(k / d) && names[k].unit == names[0].unit;
    if (all) return d;
  }
  return 0;
}

// The gradients of the constraints at places that can be moved.
class Gradients {
 public:
  Gradients(const Model& model, double t, const std::vector<double>& state)
      : constraints_(model.holonomic_constraints<double>()), t_(t), state_(state), n_(state.size() / 2) {}

  [[nodiscard]] std::size_t count() const { return constraints_->count(); }
  // False where the constraints depend on each other.
  bool place() {
    const std::span<const double> z(state_);
    return constraints_->linearise(t_, z.first(n_), z.subspan(n_)) == Status::converged;
  }
  [[nodiscard]] std::vector<double> of(std::size_t k) const {
    std::vector<double> unit(count(), 0.0), gradient(n_);
    unit[k] = 1;
    constraints_->apply_transpose(std::span<const double>(unit), std::span<double>(gradient));
    return gradient;
  }
  double& position(std::size_t k) { return state_[k]; }

 private:
  HolonomicPointer<double> constraints_;
  double t_;
  std::vector<double> state_;
  std::size_t n_;
};

std::vector<std::size_t> touched(const std::vector<double>& gradient, std::size_t d) {
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < gradient.size(); ++k)
    if (gradient[k] != 0 && (points.empty() || points.back() != k / d)) points.push_back(k / d);
  return points;
}

// Whether a constraint with this gradient holds two points at a distance: along the line between them, and
// opposite.
bool holds_apart(const std::vector<double>& gradient, Gradients& gradients, std::size_t first,
                 std::size_t second, std::size_t d) {
  double along = 0, apart = 0, size = 0;
  for (std::size_t i = 0; i < d; ++i) {
    const double way = gradients.position(first * d + i) - gradients.position(second * d + i);
    const double slope = gradient[first * d + i];
    along += slope * way;
    apart += way * way;
    size += slope * slope;
  }
  for (std::size_t i = 0; i < d; ++i) {
    const double way = gradients.position(first * d + i) - gradients.position(second * d + i);
    const double slope = gradient[first * d + i], other = gradient[second * d + i];
    if (!(std::abs(slope + other) + std::abs(slope - along / apart * way) <= 1e-9 * std::sqrt(size)))
      return false;
  }
  return true;
}

// The place a that the constraint k holds a point at a distance from. Its gradient g = c (q - a) keeps its
// direction along itself, and grows there by c times the way. Empty where it does otherwise.
std::vector<double> fixed_place(Gradients& gradients, std::size_t k, std::size_t point, std::size_t d) {
  const std::vector<double> before = gradients.of(k);
  constexpr double way = 0.125;  // in lengths of the gradient; differences are exact in linear gradients
  for (std::size_t i = point * d; i < (point + 1) * d; ++i) gradients.position(i) += way * before[i];
  const bool placed = gradients.place();
  const std::vector<double> after = placed ? gradients.of(k) : before;
  for (std::size_t i = point * d; i < (point + 1) * d; ++i) gradients.position(i) -= way * before[i];
  if (!gradients.place() || !placed) return {};
  double along = 0, size = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    along += before[i] * after[i];
    size += before[i] * before[i];
  }
  const double growth = along / size - 1;  // c times the way
  if (!(growth > 1e-9)) return {};
  std::vector<double> place;
  for (std::size_t i = point * d; i < (point + 1) * d; ++i) {
    if (std::abs(after[i] - (1 + growth) * before[i]) > 1e-9 * std::sqrt(size)) return {};
    const double q = gradients.position(i), length = before[i] * way / growth, a = q - length;
    place.push_back(std::abs(a) < 1e-12 * (std::abs(q) + std::abs(length)) ? 0.0 : a);
  }
  return place;
}

}  // namespace

std::vector<Link> links_of(const Model& model, double t, const std::vector<double>& state) {
  if (!model.content().has(Facet::holonomic)) return {};  // beside constraints of velocities, too
  const std::size_t d = dimension_of_points(model, state.size() / 2);
  if (d == 0) return {};
  Gradients gradients(model, t, state);
  if (!gradients.place()) return {};
  std::vector<Link> links;
  for (std::size_t k = 0; k < gradients.count(); ++k) {
    const std::vector<double> gradient = gradients.of(k);
    const std::vector<std::size_t> points = touched(gradient, d);
    if (points.size() == 2 && holds_apart(gradient, gradients, points[0], points[1], d))
      links.push_back({points[0], points[1], {}});
    if (points.size() != 1) continue;
    if (std::vector<double> place = fixed_place(gradients, k, points[0], d); !place.empty())
      links.push_back({points[0], std::nullopt, std::move(place)});
  }
  return links;
}

}  // namespace pfaff
