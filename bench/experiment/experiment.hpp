// Experiments: every case (a system and how long it runs) with every method and step size, read from TOML,
// run in parallel, and resumed after an interruption.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/bench/runner/record.hpp>

namespace pfaff {

struct ExperimentMethod {
  std::string label, integrator, formulation;
  Assignments set;  // parameters of the integrator, or of the formulation as formulation.KEY
  std::vector<std::string>
      tolerances;  // of a method that chooses its steps; such a method ignores the case's steps
};

struct ExperimentCase {
  std::string name, title, system, time;
  Assignments set;
  std::vector<std::string> initial, steps;
  std::string conserved;            // the invariant whose drift is shown
  std::vector<std::string> motion;  // two coordinates, whose tracks in their plane are drawn; or none
  Precision precision = Precision::double_precision;
  std::vector<std::string> methods;  // labels; empty: all
  int seeds = 0;                     // > 0: an ensemble over the system's parameter `seed` = 1 ... seeds
  bool structure = true;             // false: no structure residuals; ensembles have none in any case
  bool reference = true;             // false: no reference solution, as for long chaotic runs
};

/// A statement of an experiment about a number that two of its methods (or one method and a bound) produce;
/// it is checked on the runs.
struct ExperimentClaim {
  std::string of;       // name of the case
  std::string measure;  // error_max, error_final, or NAME:max, rms, final, growth of an invariant or residual
  std::string first, second;     // labels of methods; with an empty second, `bound` is compared with
  std::string relation, step;    // "exceeds" or "stays-below"; a step or tolerance, or empty for all of them
  double bound = 0, factor = 1;  // the second number is multiplied by the factor
  std::size_t at_least = 0;      // pairs of runs in which it must hold; 0: in every pair
};

struct Experiment {
  std::string name, title, description;
  std::vector<std::string> reference, notes;
  std::vector<ExperimentMethod> methods;
  std::vector<ExperimentCase> cases;
  std::vector<ExperimentClaim> claims;
  bool quick = false;
  bool compile = false;  // as `compile = yes` of every run
};

/// Names of the experiments that are installed with the program.
std::vector<std::string> experiment_names();

/// Reads an experiment, given the name of an installed one or the path of a TOML file. With `quick` the
/// [quick] table of each case overrides its settings. InputError for unknown keys (with the nearest known
/// one) and wrong types.
Experiment read_experiment(const std::string& name_or_path, bool quick);

/// True where the case is run with the method.
bool takes(const ExperimentCase& one, const ExperimentMethod& method);

/// One run of an experiment.
struct ExperimentRun {
  const ExperimentCase* which = nullptr;
  const ExperimentMethod* method = nullptr;
  std::string step, tolerance;  // one of them is empty
  int seed = 0;                 // 1, 2, ... in an ensemble, otherwise 0
  std::string slug;             // its directory under runs/
  ResolvedRun resolved;
};

/// All runs of an experiment. Every one is resolved and checked here, so that mistakes are found before any
/// work starts.
std::vector<ExperimentRun> expand(const Experiment& experiment);

struct ExperimentOutcome {
  std::size_t runs = 0, resumed = 0, failed = 0;
  std::filesystem::path report;
  std::string table;                                  // what the terminal shows
  nlohmann::json findings = nlohmann::json::array();  // of the experiment's claims, see findings_of
  std::string failed_claims;                          // one line; empty where every claim holds
};

/// Called with what is being done, the number of runs done, and the number of runs in all.
using ExperimentProgress = std::function<void(const std::string& what, std::size_t done, std::size_t all)>;

/// Runs what `directory` does not hold yet, then writes results.csv, cost.csv (each run timed alone, one
/// after another), figures and report.html. Runs that are damaged or were made with other settings are made
/// anew. InputError where another process works in the directory, where it holds another experiment, and,
/// unless `force` says to make them anew, where it holds runs made from other files or builds.
ExperimentOutcome run_experiment(const Experiment& experiment, const std::filesystem::path& directory,
                                 const ExperimentProgress& progress, bool force = false);

}  // namespace pfaff
