// Experiments: every case (a system and how long it runs) with every method and step size, read from TOML,
// run in parallel, and resumed after an interruption.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <pfaff/bench/runner/json.hpp>

#include <pfaff/bench/experiment/derivation_study.hpp>
#include <pfaff/bench/experiment/parameter_grid.hpp>
#include <pfaff/bench/runner/directory_lock.hpp>
#include <pfaff/bench/runner/measure_tables.hpp>
#include <pfaff/bench/runner/record.hpp>

namespace pfaff {

struct ExperimentMethod {
  std::string label, integrator, formulation;
  std::string of_grid;    // the label of the table that it is a point of, where it is one of several
  bool selected = false;  // taken from the registry, and left out of cases that it does not fit
  Assignments set;        // parameters of the integrator, or of the formulation as formulation.KEY
  std::shared_ptr<const MethodInstance> object;  // in the place of what is registered as `integrator`
  std::vector<std::string>
      tolerances;  // of a method that chooses its steps; such a method ignores the case's steps
  std::vector<std::string> absolute;  // beside each of them: none, one for all coordinates, or one for each
};

/// What stands above the sentence of a report: the equation of the motion in prose
/// (bench/report/equation.py), the question that it asks and the kind of its answer; each may be empty.
struct Asked {
  std::string equation, question, answer;
};

struct ExperimentCase {
  std::string name, title, system, time;
  Assignments set;
  std::vector<std::string> initial, initial_velocities, steps;  // steps are sizes, also where the time is < 0
  bool automatic = false;  // the steps are chosen for each method (automatic_steps.hpp), and `steps` is empty
  std::optional<double> evaluations;  // that a run at a chosen step may take; default_evaluations without it
  std::map<std::string, std::vector<std::string>> chosen;  // steps by the label of the method, once chosen
  std::string conserved;  // the invariant whose drift is shown; empty: the first conserved one
  Asked asked;
  std::string error;  // the invariant whose relative drift is the error of a run (error_measure.hpp); or none
  std::vector<std::string> motion;  // two coordinates, whose tracks in their plane are drawn; or none
  Assignments frequencies;  // the settings of the measure `frequency`; none where the case names no vectors
  Precision precision = Precision::double_precision;
  std::vector<std::string> methods;  // labels; empty: all
  int seeds = 0;                     // > 0: an ensemble over the system's parameter `seed` = 1 ... seeds
  bool structure = true;             // false: no structure residuals; ensembles have none in any case
  bool reference = true;             // false: no reference solution, as for long chaotic runs
  bool errors_at_every_row = false;  // otherwise at most_error_rows rows of a run at most
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

/// Which of the registered methods an experiment takes beside those that it names. Claims and orders are
/// those on the system of each case.
struct MethodSelection {
  std::vector<Claim> keeps;                         // all of them
  std::vector<Facet> needs;                         // all of them, among what a method cannot do without
  std::vector<std::pair<std::string, int>> orders;  // "=", ">=", "<=", ">" or "<", and than what; all of them
  AssignmentLists set;                              // values for the methods that have such a parameter
};

struct Experiment {
  std::string name, title, description;
  Asked asked;  // of all cases that have nothing of their own
  std::vector<std::string> reference, notes;
  std::vector<ExperimentMethod> methods;
  std::optional<MethodSelection> selection;
  std::vector<ExperimentCase> cases;
  std::vector<ExperimentClaim> claims;
  std::optional<Measures> measures;           // that it names; without a list the usual ones
  std::optional<DerivationStudy> derivation;  // in the place of methods, cases and claims
  bool quick = false;
  bool compile = false;   // as `compile = yes` of every run
  std::string asked_for;  // by which words of the command line, such as its name
};

/// A registered method that a selection leaves out of a case, and why.
struct LeftOut {
  std::string of_case, method, reason;
};

/// Names of the experiments that are installed with the program.
std::vector<std::string> experiment_names();

/// Reads an experiment, given the name of an installed one or the path of a TOML file. With `quick` the
/// tables [quick] and [case.quick] override titles and settings. InputError for unknown keys (with the
/// nearest known one) and wrong types. docs/experiments.md says what a file may hold.
/// `others`: methods will be added to those of the file, which may then have none.
Experiment read_experiment(const std::string& name_or_path, bool quick, bool others = false);

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

/// The run as progress and messages call it: "case weak-damping, method RK4, step 0.1".
std::string in_words(const ExperimentRun& run);
/// The name of its system as readers know it: of a text model its own, not the path of its file.
std::string system_name(const ExperimentRun& run);

/// All runs of an experiment. Every one is resolved and checked here, so that mistakes are found before any
/// work starts. Where steps are still to be chosen, one run of a single step stands for them. `left_out`,
/// where it is not null, gets what the selection of methods leaves out.
std::vector<ExperimentRun> expand(const Experiment& experiment, std::vector<LeftOut>* left_out = nullptr);

/// A run like another one, at another step or tolerance; its slug names case and method alone.
ExperimentRun at_size(const Experiment& experiment, const ExperimentRun& like, const std::string& size);

/// What the reference solution of a run depends on. All runs of a case share one solution, or all runs of one
/// seed where the case has seeds. A formulation that makes an energy of its own makes another motion, and so
/// does one whose friction has another form; these have solutions of their own, by whose names they are
/// known.
using ProblemKey = std::tuple<const ExperimentCase*, int, std::string>;
ProblemKey problem_of(const ExperimentRun& run);
/// True where a formulation makes an energy of its own, and so no motion on the constraints.
bool makes_another_motion(const Model& model);

/// Makes a run in a directory of another name and renames it, so that it is whole wherever it exists. False
/// where the run was asked to stop, and nothing is left.
bool make_run(const std::filesystem::path& directory, const ResolvedRun& run,
              const ReferenceSolution* reference);

struct ExperimentOutcome {
  std::size_t runs = 0, resumed = 0, failed = 0;
  std::filesystem::path report;                       // empty where none was asked for
  std::string table;                                  // what the terminal shows
  nlohmann::json findings = nlohmann::json::array();  // of the experiment's claims, see findings_of
  std::string failed_claims;                          // one line; empty where every claim holds
  std::vector<LeftOut> left_out;
  bool interrupted = false;             // it was asked to stop; `resumed` counts the runs that are there
  std::unique_ptr<DirectoryLock> held;  // keeps other processes out of the directory while it lives
};

/// What an experiment is at: one of its phases (runs, timings, report), and how much of that is done.
struct ExperimentStage {
  static constexpr int phases = 3;
  int phase = 1;
  std::string what;
  std::size_t done = 0, all = 0;
};
using ExperimentProgress = std::function<void(const ExperimentStage& stage)>;

class Team;

/// How an experiment is run.
struct ExperimentOptions {
  bool force = false;                       // make runs anew that were made from other files or builds
  const std::atomic<bool>* stop = nullptr;  // where it becomes true, the experiment ends; what is whole stays
  Team* team = nullptr;  // the processes that make the runs (team.hpp); null for this one alone
  bool report = true;    // draw figures and write report.html
  // Seconds for which each run is timed, instead of 0.3, or of 0.05 where the experiment is quick.
  std::optional<double> timing = std::nullopt;
};

/// Runs what `directory` does not hold yet, alone or with a team, then writes results.csv, cost.csv (each run
/// timed alone, one after another), and where they are asked for figures and report.html. Runs that are
/// damaged or were made with other settings are made anew. InputError where another process works in the
/// directory, where it holds another experiment, and, unless the options say to make them anew, where it
/// holds runs made from other files or builds.
ExperimentOutcome run_experiment(const Experiment& experiment, const std::filesystem::path& directory,
                                 const ExperimentProgress& progress, const ExperimentOptions& options = {});

}  // namespace pfaff
