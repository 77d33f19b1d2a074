// The runs of an experiment whose methods are followed once more with many states at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// Of every case without seeds and of each method, the run at the largest step that has ended well, among
/// those that are asked for.
std::vector<const ExperimentRun*> runs_at_largest_steps(
    const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
    const std::function<bool(const ResolvedRun&)>& asked_for);

/// Carries states along with the method and the step of a run, each with the history that the method may
/// need, and looks at them at the start and about `looks` times in so many steps. It ends where a step fails
/// and where `look`, which is told the number of steps, says no.
void carry(const ResolvedRun& run, std::vector<std::vector<double>>& states, std::int64_t steps, int looks,
           const std::function<bool(std::int64_t step)>& look);

}  // namespace pfaff
