#include <pfaff/bench/experiment/carried_states.hpp>

#include <algorithm>

#include <pfaff/runs/integration.hpp>

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

void carry(const ResolvedRun& run, std::vector<std::vector<double>>& states, std::int64_t steps, int looks,
           const std::function<bool(std::int64_t step)>& look) {
  std::vector<Integration<double>> carried;
  Start<double> start = start_of<double>(run);
  for (const std::vector<double>& z : states) {
    start.state = z;
    carried.emplace_back(start);
  }
  if (!look(0)) return;
  std::int64_t done = 0;
  for (int k = 1; k <= looks; ++k) {
    const std::int64_t until = steps * k / looks;
    if (until == done) continue;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (!carried[i].steps(until - done).reached()) return;
      states[i].assign(carried[i].state().begin(), carried[i].state().end());
    }
    done = until;
    if (!look(done)) return;
  }
}

}  // namespace pfaff
