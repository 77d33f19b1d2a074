#include <pfaff/runs/history.hpp>

#include <algorithm>

#include <pfaff/core/errors/budget.hpp>
#include <pfaff/runs/integration.hpp>

namespace pfaff {

namespace {
constexpr std::int64_t first_look = 3;
// Predictors and compensated sums remember earlier steps too, and change a step by its round-off.
constexpr double more_than_round_off = 1e-24;

bool differ(std::span<const Quad> a, std::span<const Quad> b) {
  Quad difference(0), size(0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    difference = std::max(difference, abs(a[k] - b[k]));
    size = std::max(size, abs(a[k]));
  }
  return difference > size * Quad(more_than_round_off);
}
bool remembers_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model, Quad t, Quad h,
                     const std::vector<Quad>& z) {
  Integration<Quad> remembering(start_with(method, model, z, h, t)), forgetting = remembering.beside(z);
  for (const std::int64_t look : {first_look, longest_beginning}) {
    if (!remembering.steps(look - remembering.steps_taken()).reached()) return false;
    forgetting.go_on_from({remembering.state().begin(), remembering.state().end()}, remembering.time(), h);
    forgetting.forget();
    if (!remembering.steps(1).reached() || !forgetting.steps(1).reached()) return false;
    if (differ(remembering.state(), forgetting.state())) return true;
  }
  return false;
}
}  // namespace

bool keeps_history(const MethodInstance& method, const std::shared_ptr<const Model>& model, Quad t, Quad h,
                   const std::vector<Quad>& z) {
  try {
    return remembers_steps(method, model, t, h, z);
  } catch (const BudgetSpent&) {
    throw;
  } catch (...) {
    return false;
  }
}

}  // namespace pfaff
