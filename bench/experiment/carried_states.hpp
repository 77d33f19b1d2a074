// The runs of an experiment whose methods are followed once more with many states at a time.
#pragma once

#include <functional>
#include <vector>

#include <pfaff/bench/experiment/experiment.hpp>

namespace pfaff {

/// Of every case without seeds and of each method, the run at the largest step that has ended well, among
/// those that are asked for.
std::vector<const ExperimentRun*> runs_at_largest_steps(
    const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
    const std::function<bool(const ResolvedRun&)>& asked_for);

}  // namespace pfaff
