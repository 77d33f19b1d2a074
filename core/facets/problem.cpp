#include <pfaff/core/facets/problem.hpp>

#include <tuple>

#include <pfaff/core/facets/scalar_units.hpp>
#include <pfaff/core/numbers/formula_scalar.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {
// A replay writes to buffers of its own. Every problem has its own replays, so that writing through a const
// context is safe.
template <class T>
void replayed(const void* context, const T& t, const T* arguments, T* results) {
  (*static_cast<Replay<T>*>(const_cast<void*>(context)))(t, arguments, results);  // NOLINT
}
}  // namespace

template <class T>
Evaluator<T> make_evaluator(const std::shared_ptr<const Model>& model, Formula formula) {
  if constexpr (std::is_same_v<T, double>)
    if (const auto compiled = model->compiled(formula)) return {compiled, model->system(), model};
  if (const FormulaProgram* program = model->program(formula)) return program->evaluator(T());
  auto replay = std::make_shared<Replay<T>>(model->tape(formula));
  const void* context = replay.get();
  return {&replayed<T>, context, std::move(replay)};
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
