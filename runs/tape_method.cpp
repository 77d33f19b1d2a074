#include <pfaff/runs/tape_method.hpp>

#include <algorithm>
#include <type_traits>

#include <pfaff/core/native/compiled_model.hpp>
#include <pfaff/core/tape/replay.hpp>
#include <pfaff/integrators/support/continuation.hpp>

namespace pfaff {

namespace {
// The method as the loop over steps sees it.
struct ReplayedStep {
  StepTape step_tape;
  CompiledTape code;  // of double alone; without a call where the tape is replayed

  template <class P>
  struct Work {
    using T = Scalar<P>;
    std::vector<T> arguments, results;  // the state, the memory and h; the same without h
    Replay<T> replay;
    Continuation<P> continuation;
    Work(const ReplayedStep& method, const P& p)
        : arguments(p.size() + method.step_tape.memory + 1, T(0)),
          results(arguments.size() - 1),
          replay(method.step_tape.tape),
          continuation(p) {}
  };

  template <class P>
  Status step(const P& p, const Scalar<P>& t, const Scalar<P>& h, State<P>& z, Work<P>& w) const {
    const std::size_t size = p.size();
    const bool remembers = step_tape.memory > 0;
    if (remembers && !w.continuation.holds(t, h, z)) w.arguments.assign(w.arguments.size(), Scalar<P>(0));
    std::copy(z.begin(), z.end(), w.arguments.begin());
    w.arguments.back() = h;
    p.counters().fields += step_tape.fields;
    evaluate<P>(t, w);
    std::copy_n(w.results.begin(), size, z.begin());
    std::copy(w.results.begin() + static_cast<std::ptrdiff_t>(size), w.results.end(),
              w.arguments.begin() + static_cast<std::ptrdiff_t>(size));
    if (remembers) w.continuation.remember(t + h, h, z);
    return Status::converged;
  }

 private:
  template <class P>
  void evaluate(const Scalar<P>& t, Work<P>& w) const {
    if constexpr (std::is_same_v<Scalar<P>, double>)
      if (code.call != nullptr) {
        code.call(nullptr, t, w.arguments.data(), w.results.data());
        return;
      }
    w.replay(t, w.arguments.data(), w.results.data());
  }
};
}  // namespace

StepTape TapeMethod::on(const std::shared_ptr<const Model>& model) const {
  const auto find = [&]() -> const StepTape* {
    for (const auto& [known, tape] : known_)
      if (known.lock() == model) return &tape;
    return nullptr;
  };
  {
    const std::lock_guard lock(mutex_);
    if (const StepTape* found = find()) return *found;
  }
  // Not under the lock: whoever records may wait for another thread, which waits for this lock.
  StepTape made = record_(model);
  const std::lock_guard lock(mutex_);
  if (const StepTape* found = find()) return *found;
  std::erase_if(known_, [](const auto& one) { return one.first.expired(); });
  return known_.emplace_back(model, std::move(made)).second;
}

template <class T>
StepperPointer<T> TapeMethod::made(std::shared_ptr<const Model> model) const {
  ReplayedStep method{on(model), {}};
  if (std::is_same_v<T, double> && statement_.compiled)
    method.code = compiled(*method.step_tape.tape, "method " + statement_.descriptor.name);
  return std::make_unique<detail::SteppingOn<ReplayedStep, Problem<T>>>(method, std::move(model));
}

template StepperPointer<double> TapeMethod::made(std::shared_ptr<const Model>) const;
template StepperPointer<Quad> TapeMethod::made(std::shared_ptr<const Model>) const;
template StepperPointer<StepDual<double>> TapeMethod::made(std::shared_ptr<const Model>) const;
template StepperPointer<StepDual<Quad>> TapeMethod::made(std::shared_ptr<const Model>) const;

}  // namespace pfaff
