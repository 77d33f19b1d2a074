// Evaluators in lanes of doubles.
#include <pfaff/core/facets/problem.hpp>
#include <pfaff/core/facets/replaying.hpp>

namespace pfaff {

template <int W>
Evaluator<Pack<W>> make_evaluator_in_lanes(const std::shared_ptr<const Model>& model, Formula formula) {
  if (model->compiled(formula) != nullptr) {
    if constexpr (W <= 8)
      if (const auto compiled = model->compiled_in_lanes<W>(formula))
        return {compiled, model->system(), model};
    return {};
  }
  if (const FormulaProgram* program = model->program(formula)) {
    if constexpr (W == 8) return program->in_lanes();
    return {};
  }
  return replaying<Pack<W>>(model->tape(formula));
}
template Evaluator<Pack<4>> make_evaluator_in_lanes(const std::shared_ptr<const Model>&, Formula);
template Evaluator<Pack<8>> make_evaluator_in_lanes(const std::shared_ptr<const Model>&, Formula);
template Evaluator<Pack<32>> make_evaluator_in_lanes(const std::shared_ptr<const Model>&, Formula);

}  // namespace pfaff
