// Experiments: cases x methods x steps, read from TOML, run in parallel, resumed after an interruption.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pfaff/bench/runner/record.hpp>

namespace pfaff {

struct ExperimentMethod {
  std::string label, integrator, formulation;
  Assignments set;                      // of the integrator, or named formulation.KEY
  std::vector<std::string> tolerances;  // of a method that chooses its steps, which takes none of the case's
};

struct ExperimentCase {
  std::string name, title, system, time;
  Assignments set;
  std::vector<std::string> initial, steps;
  std::string conserved;  // the invariant whose drift is shown
  Precision precision = Precision::double_precision;
  std::vector<std::string> methods;  // labels; empty: all
  int seeds = 0;                     // > 0: an ensemble over the system's parameter `seed` = 1 ... seeds
  bool structure = true;             // false: no structure residuals; ensembles have none in any case
  bool reference = true;             // false: no reference solution, as for long chaotic runs
};

/// What an experiment states of two of its methods, or of one and a bound, to be checked on its runs.
struct ExperimentClaim {
  std::string of;       // name of the case
  std::string measure;  // error_max, error_final, or NAME:max, rms, final, growth of an invariant or residual
  std::string first, second;     // labels; no second: `bound` instead
  std::string relation, step;    // "exceeds" or "stays-below"; the step or tolerance, empty: all
  double bound = 0, factor = 1;  // the second is multiplied by the factor
  std::size_t at_least = 0;      // 0: every pair
};

struct Experiment {
  std::string name, title, description;
  std::vector<std::string> reference, notes;
  std::vector<ExperimentMethod> methods;
  std::vector<ExperimentCase> cases;
  std::vector<ExperimentClaim> claims;
  bool quick = false;
};

/// Names of the experiments that ship.
std::vector<std::string> experiment_names();

/// Reads an experiment by the name of one that ships or by the path of a TOML file. `quick` takes each case's
/// [quick] overrides. InputError for unknown keys (with the nearest) and wrong types.
Experiment read_experiment(const std::string& name_or_path, bool quick);

/// Whether a case is run with a method.
bool takes(const ExperimentCase& one, const ExperimentMethod& method);

/// One run of an experiment.
struct ExperimentRun {
  const ExperimentCase* which = nullptr;
  const ExperimentMethod* method = nullptr;
  std::string step, tolerance;  // one of them is empty
  int seed = 0;                 // of an ensemble, else 0
  std::string slug;             // its directory under runs/
  ResolvedRun resolved;
};

/// Every run, resolved and checked, before any work starts.
std::vector<ExperimentRun> expand(const Experiment& experiment);

struct ExperimentOutcome {
  std::size_t runs = 0, resumed = 0, failed = 0;
  std::filesystem::path report;
  std::string table;                                  // what the terminal shows, at most 100 columns
  nlohmann::json findings = nlohmann::json::array();  // of the experiment's claims, see findings_of
  std::string failed_claims;                          // one line; empty where every claim holds
};

/// Reports progress of the whole: what is being done, runs done, runs in all.
using ExperimentProgress = std::function<void(const std::string& what, std::size_t done, std::size_t all)>;

/// Runs what `directory` does not hold yet, then writes results.csv, cost.csv (timed alone, serially),
/// figures and report.html. A directory that holds another experiment is refused (InputError).
ExperimentOutcome run_experiment(const Experiment& experiment, const std::filesystem::path& directory,
                                 const ExperimentProgress& progress);

}  // namespace pfaff
