// Evaluators that replay a tape.
#pragma once

#include <memory>
#include <utility>

#include <pfaff/core/facets/evaluator.hpp>
#include <pfaff/core/tape/replay.hpp>

namespace pfaff {

/// The evaluator of a tape with scalar T. A replay writes to buffers of its own. Every problem has its own
/// evaluators, so that writing through a const context is safe.
template <class T>
Evaluator<T> replaying(std::shared_ptr<const Tape> tape) {
  auto replay = std::make_shared<Replay<T>>(std::move(tape));
  const void* context = replay.get();
  return {[](const void* c, const T& t, const T* arguments, T* results) {
            (*static_cast<Replay<T>*>(const_cast<void*>(c)))(t, arguments, results);  // NOLINT
          },
          context, std::move(replay)};
}

}  // namespace pfaff
