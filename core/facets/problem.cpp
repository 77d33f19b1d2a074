#include <pfaff/core/facets/problem.hpp>

#include <pfaff/core/facets/scalars.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

namespace {
// A replay keeps buffers; each problem has its own, so writing to them through a const context is safe.
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

template Evaluator<double> make_evaluator(const std::shared_ptr<const Model>&, Formula);
template Evaluator<Quad> make_evaluator(const std::shared_ptr<const Model>&, Formula);
template Evaluator<StepDual<double>> make_evaluator(const std::shared_ptr<const Model>&, Formula);
template Evaluator<StepDual<Quad>> make_evaluator(const std::shared_ptr<const Model>&, Formula);

}  // namespace pfaff
