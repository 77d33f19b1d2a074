#include <pfaff/runs/shared_solution.hpp>

#include <pfaff/runs/motion.hpp>

namespace pfaff {

std::shared_ptr<const ReferenceSolution> SharedSolution::to(const Quad& duration) const {
  const std::lock_guard lock(mutex_);
  const bool far_enough = duration < Quad(0) ? duration_ <= duration : duration <= duration_;
  if (longest_ == nullptr || !far_enough) {
    longest_ = std::make_shared<ReferenceSolution>(solved_model(model_), t0_, initial_, duration);
    duration_ = duration;
  }
  return longest_;
}

}  // namespace pfaff
