#include <pfaff/runs/support/history.hpp>

#include <algorithm>

#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

namespace {
constexpr std::int64_t first_look = 3;
// Predictors and compensated sums remember earlier steps too, and change a step by its round-off.
constexpr double more_than_round_off = 1e-24;

bool differ(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  Quad difference(0), size(0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    difference = std::max(difference, abs(a[k] - b[k]));
    size = std::max(size, abs(a[k]));
  }
  return difference > size * Quad(more_than_round_off);
}
bool remembers_steps(const MethodInstance& method, const std::shared_ptr<const Model>& model, Quad t, Quad h,
                     const std::vector<Quad>& z) {
  const auto running = method.stepper(model, Quad()), fresh = method.stepper(model, Quad());
  std::vector<Quad> remembering = z;
  std::int64_t done = 0, completed = 0;
  for (const std::int64_t look : {first_look, longest_beginning}) {
    if (running->advance(t, done, h, look - done, remembering, completed) != Status::converged) return false;
    std::vector<Quad> forgetting = remembering;
    fresh->forget();
    if (running->advance(t, look, h, 1, remembering, completed) != Status::converged) return false;
    if (fresh->advance(t, look, h, 1, forgetting, completed) != Status::converged) return false;
    if (differ(remembering, forgetting)) return true;
    done = look + 1;
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
