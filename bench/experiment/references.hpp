// The solutions that the runs of an experiment are compared with.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/runs/shared_solution.hpp>

namespace pfaff {

/// Reference solutions, each shared by all runs of one problem. Threads may ask at once.
class References {
 public:
  /// Over the whole of the run; null where its case compares with none. It stays while these do, since no
  /// run of a problem takes longer than another.
  const ReferenceSolution* of(const ExperimentRun& run) {
    return run.which->reference ? problem(run).to(run.resolved.time.quad()).get() : nullptr;
  }
  /// Whatever the case compares with.
  const SharedSolution& problem(const ExperimentRun& run) {
    const std::lock_guard lock(mutex_);
    auto& slot = problems_[problem_of(run)];
    if (slot == nullptr) slot = solution_of(run.resolved);
    return *slot;
  }

 private:
  std::mutex mutex_;
  std::map<ProblemKey, std::unique_ptr<SharedSolution>> problems_;
};

}  // namespace pfaff
