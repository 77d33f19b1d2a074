#include <pfaff/runs/support/chosen_steps.hpp>

#include <vector>

namespace pfaff {

bool adaptive_in_quad(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  if (!method.adaptive()) return false;
  const auto stepper = method.stepper(model, Quad());
  std::vector<Quad> z(static_cast<std::size_t>(model->dimension()));
  Quad t(0);
  try {
    (void)stepper->advance_to(t, t, Quad(1), z);
    return true;
  } catch (const InputError&) {  // what a stepper throws in whose scalar the method takes fixed steps only
    return false;
  }
}

}  // namespace pfaff
