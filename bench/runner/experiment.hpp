// Experiments: cases x methods x steps, read from TOML, run in parallel, resumed after an interruption.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/bench/runner/record.hpp>

namespace pfaff {

struct ExperimentMethod {
  std::string label, integrator, formulation;
  Assignments set;  // of the integrator, or named formulation.KEY
};

struct ExperimentCase {
  std::string name, title, system, time;
  Assignments set;
  std::vector<std::string> initial, steps;
  std::string conserved;  // the invariant whose drift is shown
  Precision precision = Precision::double_precision;
  std::vector<std::string> methods;  // labels; empty: all
};

struct Experiment {
  std::string name, title, description;
  std::vector<std::string> reference, notes;
  std::vector<ExperimentMethod> methods;
  std::vector<ExperimentCase> cases;
  bool quick = false;
};

/// Names of the experiments that ship.
std::vector<std::string> experiment_names();

/// Reads an experiment by the name of one that ships or by the path of a TOML file. `quick` takes each case's
/// [quick] overrides. InputError for unknown keys (with the nearest) and wrong types.
Experiment read_experiment(const std::string& name_or_path, bool quick);

/// One run of an experiment.
struct ExperimentRun {
  const ExperimentCase* which = nullptr;
  const ExperimentMethod* method = nullptr;
  std::string step;
  std::string slug;  // its directory under runs/
  ResolvedRun resolved;
};

/// Every run, resolved and checked, before any work starts.
std::vector<ExperimentRun> expand(const Experiment& experiment);

struct ExperimentOutcome {
  std::size_t runs = 0, resumed = 0, failed = 0;
  std::filesystem::path report;
  std::string table;  // what the terminal shows, at most 100 columns
};

/// Reports progress of the whole: what is being done, runs done, runs in all.
using ExperimentProgress = std::function<void(const std::string& what, std::size_t done, std::size_t all)>;

/// Runs what `directory` does not hold yet, then writes results.csv, cost.csv (timed alone, serially),
/// figures and report.html. A directory that holds another experiment is refused (InputError).
ExperimentOutcome run_experiment(const Experiment& experiment, const std::filesystem::path& directory,
                                 const ExperimentProgress& progress);

}  // namespace pfaff
