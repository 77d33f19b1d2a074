// The state at which claims are measured.
#include <algorithm>
#include <cmath>

#include <pfaff/core/facets/stated_ranges.hpp>
#include <pfaff/runs/support/constraints.hpp>
#include <pfaff/verify/check_budget.hpp>
#include <pfaff/verify/residuals.hpp>
#include <pfaff/verify/step_scale.hpp>

namespace pfaff {

Real generic_time_of(const Model& model) {
  const Real fraction = Real::fraction(37, 100);
  return model.moves() ? fraction * Real(own_time(model, Real(0), model.initial())) : fraction;
}

bool Region::contains(std::span<const Quad> z) const {
  for (std::size_t k = 0; k < std::min(z.size(), box.size()); ++k)
    if (!within(box[k], z[k])) return false;
  return true;
}

std::vector<Real> generic_state(const Model& model) {
  if (model.initial().size() != static_cast<std::size_t>(model.dimension()))
    throw InputError("system " + model.name() + " has " + std::to_string(model.initial().size()) +
                     " initial values, near which its claims are measured; expected " +
                     std::to_string(model.dimension()));
  std::vector<Real> z = model.initial();
  const std::vector<double> scales = coordinate_scales(model);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const auto i = static_cast<std::int64_t>(k);
    // Offsets that grow with the index would tear systems of many bodies apart, so they repeat with
    // constraints, and where they are parts of a coordinate's own size.
    const std::int64_t amount = model.restricted() || scales[k] != 1 ? i % 5 : i;
    const Real offset = Real::fraction(i % 2 == 0 ? 7 + 2 * amount : -5 - 3 * amount, 101);
    z[k] = z[k] + (scales[k] == 1 ? offset : Real(Quad(scales[k])) * offset);
    if (k < model.coordinates().size()) z[k] = inside(model.coordinates()[k].range, model.initial()[k], z[k]);
  }
  if (model.restricted()) {
    std::vector<Quad> moved;
    for (const Real& x : z) moved.push_back(x.quad());
    const auto projection = project_onto_constraints(model, generic_time_of(model).quad(), moved);
    if (projection.status != Status::converged)
      throw InputError("system " + model.name() +
                       ": no state on its constraints was found near its initial state (" +
                       std::string(to_string(projection.status)) + ")");
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = Real(moved[k]);
  }
  return z;
}

namespace {
// Adds the states that the motion from the first centre reaches in one direction of time: after `elapsed`,
// twice, four times that.
void add_states(Region& region, const Model& motion, const Real& t, const Quad& elapsed, int states) {
  constexpr double most_growth = 8;
  std::vector<Quad> z;
  for (const Real& x : region.centres.front()) z.push_back(x.quad());
  const Quad first = largest_of(z);
  Quad done(0);
  for (int k = 0; k < states; ++k) {
    const Quad next = elapsed * Quad(std::ldexp(1.0, k));
    try {
      short_flow(motion, t.quad() + done, next - done, z);
    } catch (const SolutionEnds&) {
      return;
    }
    done = next;
    if (!(largest_of(z) <= Quad(most_growth) * first) || !region.contains(z)) return;
    region.centres.emplace_back(z.begin(), z.end());
    region.times.push_back(static_cast<double>(t.quad() + done));
  }
}
}  // namespace

int own_times_followed(const Model& motion) {
  // The Taylor series of long formulas take most of the time of these checks.
  constexpr std::size_t few_operations = 512;
  return motion.tape(Formula::field)->code.size() <= few_operations ? 32 : 4;
}

Region region_of(const Model& motion, std::vector<Real> centre) {
  Region region(std::move(centre));
  if (!motion.restricted() && motion.source().formulation.empty())
    region.box = stated_ranges(motion.coordinates());
  if (!motion.moves() || !is_short(motion)) return region;
  const Real t = generic_time_of(motion);
  const Quad time = own_time(motion, t, region.centres.front());
  const int states = 1 + static_cast<int>(std::log2(own_times_followed(motion)));
  for (const double direction : {1.0, -1.0}) add_states(region, motion, t, Quad(direction) * time, states);
  return region;
}

Region Region::first(std::size_t count) const {
  Region region(*this);
  for (std::vector<Real>& centre : region.centres) centre.resize(count);
  if (!region.box.empty()) region.box.resize(count, unbounded);
  return region;
}

Region Region::with_zero() const {
  Region region(*this);
  for (std::vector<Real>& centre : region.centres) centre.emplace_back(0);
  return region;
}

}  // namespace pfaff
