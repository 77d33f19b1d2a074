#include <pfaff/runs/shared_solution.hpp>

#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/state_checks.hpp>

namespace pfaff {

namespace {
// A run may be told to begin elsewhere.
bool begins_on_constraints(const Model& model, const Quad& t0, std::vector<Quad> start) try {
  return !model.restricted() || consistency_of(model, t0, start).on_constraints();
} catch (const InputError&) {
  return false;  // there is no state on them near it
}
}  // namespace

std::shared_ptr<const ReferenceSolution> SharedSolution::to(const Quad& duration) const {
  const std::lock_guard lock(mutex_);
  const bool far_enough = duration < Quad(0) ? duration_ <= duration : duration <= duration_;
  if (longest_ == nullptr || !far_enough) {
    const std::shared_ptr<const Model> motion = solved_model(model_);
    const auto solution = std::make_shared<const ReferenceSolution>(motion, t0_, initial_, duration);
    if (motion->facets().has(Facet::exact_solution) && begins_on_constraints(*model_, t0_, initial_))
      solution->check_closed_form(duration);
    longest_ = solution;
    duration_ = duration;
  }
  return longest_;
}

}  // namespace pfaff
