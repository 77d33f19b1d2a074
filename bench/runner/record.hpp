// Running a method on a system and what is known of the run when it has ended: drift, accuracy, structure
// residuals and cost counts. Its samples are passed on while it goes.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/bench/runner/series.hpp>
#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/runs/shared_solution.hpp>
#include <pfaff/runs/support/reference.hpp>
#include <pfaff/runs/support/structure.hpp>
#include <pfaff/runs/watched/constraints.hpp>
#include <pfaff/runs/watched/invariants.hpp>

namespace pfaff {

/// What is found when it is first asked for, and kept; not by several threads at once. A default value where
/// there is no way to find it.
template <class V>
class Later {
 public:
  Later() = default;
  explicit Later(std::function<V()> find) : find_(std::move(find)) {}
  const V& operator()() const {
    if (find_) found_ = std::exchange(find_, nullptr)();
    return found_;
  }

 private:
  mutable std::function<V()> find_;
  mutable V found_{};
};

struct RunRecord {
  Status status = Status::converged;
  bool interrupted = false;  // it was asked to stop, and did so after `completed` steps
  std::string message;       // why a run ended early, one line
  std::int64_t completed = 0;
  std::int64_t sample_count = 0;       // the first one is at the start,
  Quad last_sample;                    // the last one at this time
  std::vector<Quad> first_invariants;  // at the first sample
  Later<InvariantsLeft> invariants;    // classing drifts takes longer than a short run
  Later<ConstraintsLeft> constraints;  // likewise
  std::optional<double> error_max, error_final, structure_residual;
  std::string reference;          // what the errors are against, ReferenceSolution::kind; empty without
  std::string reference_ended;    // why they are measured over a part of the run or not at all, one line
  std::int64_t error_rows = 0;    // at how many rows behind the first they are measured,
  std::int64_t reached_rows = 0;  // of how many to which the solution reaches
  int structure_failures =
      0;  // samples from which no step could be differentiated, or not to a finite number
  Counters counters;
};

/// Called now and then with the fraction of a run that is done.
using Progress = std::function<void(double fraction)>;

/// Runs to the end, or to where the method fails or something measured is not finite: the state, an
/// invariant, its drift, a residual or the error. The samples completed by then are kept.
/// `reference` may be null, and errors are then not measured; where it ends before the run, they are measured
/// up to there. Of many rows some are compared with it (most_error_rows), the last one among them. Structure
/// residuals are measured at about fifty samples, where the model has a structure and at most 64 coordinates.
/// Where `stop` becomes true, the run ends after the steps that it has taken by then, which are looked at in
/// blocks. `samples`, where there is one, takes the samples while the run goes. RunError, naming the method,
/// the system and the time, where a step or a formula throws.
RunRecord execute(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress = {},
                  const std::atomic<bool>* stop = nullptr, SampleTaker* samples = nullptr);

/// The solution of the problem of a run, over any time.
std::unique_ptr<SharedSolution> solution_of(const ResolvedRun& run);
/// The solution that a run is compared with: the exact one where the system has it, otherwise Taylor steps of
/// its motion in quad.
std::shared_ptr<const ReferenceSolution> reference_of(const ResolvedRun& run);

/// The same, or null where the settings of the run ask for no errors or the system has no exact solution that
/// they ask for.
std::shared_ptr<const ReferenceSolution> reference_asked_for(const ResolvedRun& run);

/// Nanoseconds per step, measured while nothing else runs: one warm-up, then repeated runs from the initial
/// state. For a method that chooses its steps, these are the steps it takes over a stretch of the run.
struct StepTime {
  double median = 0, minimum = 0, maximum = 0, seconds = 0;
  int repetitions = 0;
};
StepTime time_steps(const ResolvedRun& run, double seconds);

/// The schema of summary.json and of experiment.json. Runs of an older one are made anew.
inline constexpr int schema_of_runs = 2;
/// The content of summary.json, but for the checksum that write_run adds.
nlohmann::json summary(const ResolvedRun& run, const RunRecord& record);

/// The largest move of an invariant against its expected direction, read from the invariant's entry in
/// summary.json.
struct SetbackInSummary {
  std::string move, expected;  // "rise" and "decrease", or "fall" and "increase"
  nlohmann::json size;         // a number, or null where it is not finite
};
/// The setback in `invariant`; nothing where the invariant has no expected direction.
std::optional<SetbackInSummary> setback_in(const nlohmann::json& invariant);
/// Versions and flags of this build.
nlohmann::json versions();

}  // namespace pfaff
