#include <pfaff/bench/measure/history.hpp>

#include <algorithm>

namespace pfaff {

namespace {
constexpr int steps_before = 3;
// Predictors and compensated sums remember earlier steps too, and change a step by its round-off.
constexpr double more_than_round_off = 1e-24;
}  // namespace

bool keeps_history(const MethodInstance& method, const std::shared_ptr<const Model>& model, Quad t, Quad h,
                   const std::vector<Quad>& z) {
  const auto stepper = method.stepper(model, Quad());
  std::vector<Quad> before = z;
  std::int64_t completed = 0;
  if (stepper->advance(t, 0, h, steps_before, before, completed) != Status::converged) return false;
  std::vector<Quad> remembering = before, forgetting = before;
  if (stepper->advance(t, steps_before, h, 1, remembering, completed) != Status::converged) return false;
  stepper->forget();
  if (stepper->advance(t, steps_before, h, 1, forgetting, completed) != Status::converged) return false;
  Quad difference(0), size(0);
  for (std::size_t k = 0; k < z.size(); ++k) {
    difference = std::max(difference, abs(remembering[k] - forgetting[k]));
    size = std::max(size, abs(remembering[k]));
  }
  return difference > size * Quad(more_than_round_off);
}

}  // namespace pfaff
