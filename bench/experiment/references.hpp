// The solutions that the runs of an experiment are compared with.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/core/errors/budget.hpp>

namespace pfaff {

/// Reference solutions, each shared by all runs of one problem and made when it is first asked for. Threads
/// may ask at once; one that asks while a solution is made waits for it.
class References {
 public:
  /// Where `stop` becomes true, a solution that is being made ends where it is.
  explicit References(const std::atomic<bool>* stop = nullptr) : stop_(stop) {}

  /// Null where the run's case compares with none.
  const ReferenceSolution* of(const ExperimentRun& run) {
    if (!run.which->reference) return nullptr;
    const std::lock_guard lock(mutex_);
    auto& slot = solutions_[problem_of(run)];
    if (slot == nullptr) {
      const Budget budget({}, stop_);
      slot = reference_of(run.resolved);
    }
    return slot.get();
  }

 private:
  const std::atomic<bool>* stop_;
  std::mutex mutex_;
  std::map<ProblemKey, std::unique_ptr<ReferenceSolution>> solutions_;
};

}  // namespace pfaff
