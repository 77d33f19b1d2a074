#include <pfaff/bench/experiment/largest_steps.hpp>

#include <algorithm>

namespace pfaff {

std::vector<const ExperimentRun*> runs_at_largest_steps(
    const std::vector<ExperimentRun>& runs, const std::vector<nlohmann::json>& summaries,
    const std::function<bool(const ResolvedRun&)>& asked_for) {
  std::vector<const ExperimentRun*> largest;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const ExperimentRun& run = runs[k];
    if (run.seed > 0 || summaries[k]["status"] != "converged" || !asked_for(run.resolved)) continue;
    const auto same = std::find_if(largest.begin(), largest.end(), [&](const ExperimentRun* other) {
      return other->which == run.which && other->method == run.method;
    });
    if (same == largest.end()) {
      largest.push_back(&run);
    } else if ((*same)->resolved.step < run.resolved.step) {
      *same = &run;
    }
  }
  return largest;
}

}  // namespace pfaff
