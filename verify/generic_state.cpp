// The state at which claims are measured.
#include <algorithm>
#include <cmath>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/core/facets/stated_ranges.hpp>
#include <pfaff/core/tape/taylor_steps.hpp>
#include <pfaff/runs/support/constraints.hpp>
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
    // Offsets that grow with the index would tear systems of many bodies apart, so they repeat.
    const std::int64_t amount = i % 5;
    const Real offset = Real::fraction(i % 2 == 0 ? 7 + 2 * amount : -5 - 3 * amount, 101);
    z[k] = z[k] + Real(Quad(scales[k])) * offset;
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
    // What the projection leaves of zero is zero: noise has no size by which it could be judged.
    constexpr double noise = 1e-30;
    for (std::size_t k = 0; k < z.size(); ++k)
      z[k] = abs(moved[k]) <= Quad(noise * scales[k]) ? Real(0) : Real(moved[k]);
  }
  return z;
}

namespace {
// A motion in double, by Taylor steps whose last terms are e^-39 = 1e-17 of the first. The states that it
// reaches are places near which others are drawn, a twentieth of themselves away, so that no digit beyond
// these is seen; in quad it took two thirds of the time in which all systems are checked.
class RoughMotion {
 public:
  RoughMotion(const Model& motion, double t, std::vector<double> z)
      : steps_(motion.tape(Formula::field), order, std::exp(-39.0 / order)),
        t_(t),
        z_(std::move(z)),
        least_(z_.size()) {}

  // Moves on to a time. False where no step leads on, or so many do not lead there: towards a singularity
  // they become smaller and smaller.
  [[nodiscard]] bool reaches(double goal) {
    constexpr int most_steps = 2000;
    for (int k = 0; k < most_steps; ++k) {
      if (t_ == goal) return true;
      spend(1, 1);
      if (!steps_.expand(t_, z_.data())) return false;
      const double step = steps_.step(goal - t_, left_out_of_a_step, least_);
      if (step == 0) return false;
      for (std::size_t i = 0; i < z_.size(); ++i) {
        least_[i] = std::max(least_[i], steps_.unsized()[i]);
        z_[i] += steps_.expansion().increment(step, i);
      }
      t_ = std::abs(goal - t_) <= std::abs(step) ? goal : t_ + step;
    }
    return false;
  }
  [[nodiscard]] const std::vector<double>& state() const { return z_; }

 private:
  static constexpr int order = 18;
  static constexpr double left_out_of_a_step = 1e-14;
  TaylorSteps<double> steps_;
  double t_;
  std::vector<double> z_, least_;  // the least sizes of coordinates
};

// Adds the states that the motion from the first centre reaches in one direction of time: after `elapsed`,
// twice, four times that.
void add_states(Region& region, const Model& motion, double t, double elapsed, int states) {
  constexpr double most_growth = 8;
  // Gives a number digits behind those of double, so that formulas round in quad as they do elsewhere.
  const Quad digits = Quad(1) + Quad(0x1p-54) / Quad(3);
  std::vector<double> start;
  for (const Real& x : region.centres.front()) start.push_back(x.value());
  const double first = largest_of(start);
  RoughMotion rough(motion, t, start);
  for (int k = 0; k < states; ++k) {
    const double then = t + std::ldexp(elapsed, k);
    if (!rough.reaches(then)) return;
    std::vector<Quad> z;
    for (const double x : rough.state()) z.push_back(Quad(x) * digits);
    if (!(largest_of(rough.state()) <= most_growth * first) || !region.contains(z)) return;
    region.centres.emplace_back(z.begin(), z.end());
    region.times.push_back(then);
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
  const auto time = static_cast<double>(own_time(motion, t, region.centres.front()));
  region.times.front() = t.value(), region.own_time = time;
  const int states = 1 + static_cast<int>(std::log2(own_times_followed(motion)));
  for (const double direction : {1.0, -1.0}) add_states(region, motion, t.value(), direction * time, states);
  return region;
}

Region with_branches_of(const Tape& formula, Region region) {
  constexpr double times = 4;
  const bool branches = std::any_of(formula.code.begin(), formula.code.end(),
                                    [](const Instruction& i) { return i.operation == Operation::select; });
  if (!branches || !region.box.empty()) return region;
  for (std::size_t k = 0; k < region.centres.front().size(); ++k) {
    double smallest = region.centres.front()[k].value(), largest = smallest;
    for (const std::vector<Real>& centre : region.centres) {
      smallest = std::min(smallest, centre[k].value());
      largest = std::max(largest, centre[k].value());
    }
    const double middle = (smallest + largest) / 2, reach = times * (largest - smallest) / 2;
    region.box.push_back(reach > 0 ? Range{middle - reach, middle + reach} : unbounded);
  }
  return region;
}

Region Region::first(std::size_t count) const {
  Region region(*this);
  for (std::vector<Real>& centre : region.centres) centre.resize(count);
  if (!region.box.empty()) region.box.resize(count, unbounded);
  return region;
}

Region Region::of_elapsed_times() const {
  Region region(*this);
  region.own_time = own_time / 16;
  for (std::size_t k = 0; k < region.centres.size(); ++k) {
    region.centres[k].emplace_back(Quad(times[k]));
    region.times[k] = k % 2 == 0 ? region.own_time : -region.own_time;
  }
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  if (!box.empty()) region.box.push_back({*first, *last});
  return region;
}

}  // namespace pfaff
