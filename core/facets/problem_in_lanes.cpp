// Evaluators in lanes of doubles.
#include <pfaff/core/facets/problem.hpp>
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

template <int W>
Evaluator<Pack<W>> make_evaluator_in_lanes(const std::shared_ptr<const Model>& model, Formula formula) {
  if (model->compiled(formula) != nullptr) {
    if (const auto compiled = model->compiled_in_lanes<W>(formula)) return {compiled, model->system(), model};
    return {};
  }
  if (model->program(formula) != nullptr) return {};
  auto replay = std::make_shared<Replay<Pack<W>>>(model->tape(formula));
  const void* context = replay.get();
  return {&replayed<Pack<W>>, context, std::move(replay)};
}
template Evaluator<Pack<4>> make_evaluator_in_lanes(const std::shared_ptr<const Model>&, Formula);
template Evaluator<Pack<8>> make_evaluator_in_lanes(const std::shared_ptr<const Model>&, Formula);

}  // namespace pfaff
