#include <pfaff/core/facets/problem.hpp>

#include <tuple>

#include <pfaff/core/facets/replaying.hpp>
#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/numbers/formula_scalar.hpp>

namespace pfaff {

template <class T>
Evaluator<T> make_evaluator(const std::shared_ptr<const Model>& model, Formula formula) {
  if constexpr (std::is_same_v<T, double>)
    if (const auto compiled = model->compiled(formula)) return {compiled, model->system(), model};
  if (const FormulaProgram* program = model->program(formula)) return program->evaluator(T());
  return replaying<T>(model->tape(formula));
}

// Emits make_evaluator for every scalar of the list, and says what one of them lacks.
template <class List>
struct EvaluatorInstances;
template <class... T>
struct EvaluatorInstances<Scalars<T...>> {
  static_assert((check_step_scalar<T>() && ...));
  static constexpr std::tuple all{&make_evaluator<T>...};
};
template struct EvaluatorInstances<detail::ScalarsHere<StepScalars>>;

}  // namespace pfaff
