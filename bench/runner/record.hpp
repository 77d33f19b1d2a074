// What a run leaves in memory: samples, drift, accuracy, structure, cost counts.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pfaff/bench/measure/drift.hpp>
#include <pfaff/bench/measure/growth.hpp>
#include <pfaff/bench/measure/reference.hpp>
#include <pfaff/bench/measure/structure.hpp>
#include <pfaff/bench/runner/settings.hpp>

namespace pfaff {

/// One observed instant; numbers are kept in quad and printed in the run's precision.
struct Sample {
  Quad t;
  std::vector<Quad> state, invariants, constraints;  // the last: the largest residual of each level
  std::optional<Quad> error;                         // relative to the reference solution's norm
  std::optional<Quad> structure;                     // structure residual of one step from here
};

struct RunRecord {
  Status status = Status::converged;
  std::string message;  // why a run ended early, one line
  std::int64_t completed = 0;
  std::vector<Sample> samples;
  std::vector<Drift>
      drift;  // one for each invariant, in the model's order; meant for those expected to be conserved
  std::vector<Drift> constraints;             // of the residuals, in the order of constraint_residual_names
  std::vector<std::optional<Growth>> growth;  // of the same
  std::vector<double>
      rise;  // the largest rise of each above what it was before; for those expected to decrease
  std::optional<double> error_max, error_final, structure_residual;
  Counters counters;
};

/// Called now and then with the fraction of a run that is done.
using Progress = std::function<void(double fraction)>;

/// Runs to the end, or to where the method fails: every completed sample is kept.
/// `reference` may be null. Structure residuals are measured at about fifty samples where the model has a
/// structure and at most 64 coordinates.
RunRecord execute(const ResolvedRun& run, const ReferenceSolution* reference, const Progress& progress = {});

/// Nanoseconds per step, timed alone: one warm-up, then repeated runs from the initial state. Of a method
/// that chooses its steps, those it takes over a stretch of the run.
struct StepTime {
  double median = 0, minimum = 0, maximum = 0, seconds = 0;
  int repetitions = 0;
};
StepTime time_steps(const ResolvedRun& run, double seconds);

/// The text of series.csv.
std::string series_csv(const ResolvedRun& run, const RunRecord& record);
/// The content of summary.json.
nlohmann::json summary(const ResolvedRun& run, const RunRecord& record);
/// Versions and flags of this build.
nlohmann::json versions();

}  // namespace pfaff
