#include <pfaff/bench/experiment/experiment.hpp>

#include <algorithm>
#include <map>

#include <pfaff/bench/experiment/automatic_steps.hpp>
#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/equal_cost.hpp>
#include <pfaff/bench/experiment/experiment_description.hpp>
#include <pfaff/bench/experiment/experiment_directory.hpp>
#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/bench/experiment/measured_runs.hpp>
#include <pfaff/bench/experiment/problems.hpp>
#include <pfaff/bench/experiment/references.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/experiment/team.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/bench/studies/studies.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
// Refuses a directory that holds another experiment than the one described. True where it is to be replaced.
bool replaces_another(const fs::path& directory, const nlohmann::json& mine, bool force) {
  const fs::path identity = directory / experiment_file;
  std::error_code error;
  if (!fs::exists(identity, error)) return false;
  // Builds are left out of the comparison here; they belong to the identity of each run. A file may be named
  // by several paths.
  nlohmann::json theirs = nlohmann::json::parse(read_file(identity), nullptr, false);
  // A damaged file says nothing about the runs beside it, each of which says by itself what it is. Without
  // runs it is the file of somebody else.
  if (!theirs.is_object() || !theirs.contains("schema") || !theirs.contains("name")) {
    if (fs::is_directory(directory / "runs", error)) return false;
    throw InputError("output directory '" + directory.string() + "' holds a file " + experiment_file +
                     " that describes no experiment; expected a new directory");
  }
  if (theirs["schema"] != mine["schema"]) {
    if (force && theirs.value("name", "") == mine["name"]) return true;
    throw InputError("output directory '" + directory.string() + "' holds an experiment of schema " +
                     theirs["schema"].dump() + ", whose tables are others than those of schema " +
                     mine["schema"].dump() + "; expected a new directory, or --force to make its runs anew");
  }
  const nlohmann::json their_classes = theirs.value("drift_classes", nlohmann::json());
  theirs["versions"] = mine["versions"];
  theirs["asked_for"] = mine["asked_for"];
  theirs["drift_classes"] = mine["drift_classes"];
  refuse_another_experiment(directory, theirs, mine, force);
  if (their_classes != mine["drift_classes"])
    throw InputError("output directory '" + directory.string() +
                     "' holds runs of a version with other drift classes; expected a new directory");
  return theirs != mine;
}

// The indices of the runs that `directory` does not hold. Refuses outdated runs unless they may be made anew.
std::vector<std::size_t> runs_to_make(const fs::path& directory, const std::vector<ExperimentRun>& runs,
                                      bool force) {
  std::vector<std::size_t> open;
  std::vector<std::string> changed;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const KeptRun kept = kept_run(directory / "runs" / runs[k].slug, runs[k].resolved);
    if (!kept.current()) open.push_back(k);
    if (!kept.outdated()) continue;
    for (const std::string& phrase : kept.changed)
      if (std::find(changed.begin(), changed.end(), phrase) == changed.end()) changed.push_back(phrase);
  }
  if (!changed.empty() && !force)
    throw InputError("output directory '" + directory.string() + "' holds runs of this experiment, but " +
                     in_one_line(changed) + "; expected a new directory, or --force to make these runs anew");
  return open;
}

// A file that only some experiments have: one without it must not keep that of an earlier version of itself.
void write_or_remove(const fs::path& path, const std::string& text) {
  std::error_code error;
  if (text.empty()) {
    fs::remove(path, error);
  } else {
    write_file(path, text);
  }
}

// Removes what was made of runs that are about to change, so that nothing is left of it if the program is
// interrupted: timings of these runs, and all that is put together from several runs.
void remove_outdated(const fs::path& directory, const std::vector<ExperimentRun>& runs) {
  keep_costs(directory, runs, [&](const ExperimentRun& run) {
    return kept_run(directory / "runs" / run.slug, run.resolved).same();
  });
  remove_derived(directory);
}

// Removes the runs of an experiment that this one replaces. Those that both have stay.
void remove_other_runs(const fs::path& directory, const std::vector<ExperimentRun>& runs) {
  std::error_code error;
  std::vector<fs::path> others;
  for (const auto& entry : fs::directory_iterator(directory / "runs", error))
    if (std::none_of(runs.begin(), runs.end(),
                     [&](const ExperimentRun& run) { return run.slug == entry.path().filename(); }))
      others.push_back(entry.path());
  for (const fs::path& run : others) fs::remove_all(run, error);
}

// What the leading process does before runs are made: it takes the directory and finds what is missing.
struct Preparation {
  std::unique_ptr<DirectoryLock> held;
  std::string described;
  bool replaces = false;  // the directory holds another experiment, which is to be replaced

  void take(const Experiment& experiment, const fs::path& directory, const std::vector<ExperimentRun>& runs,
            const std::vector<LeftOut>& left_out, bool force) {
    described = description(experiment, runs, left_out).dump(1) + "\n";
    held = take_experiment_directory(directory, "pfaff compare");
    replaces = replaces_another(directory, nlohmann::json::parse(described), force);
  }

  // The indices of the runs that are missing.
  std::vector<std::size_t> find(const fs::path& directory, const std::vector<ExperimentRun>& runs,
                                bool force) const {
    std::vector<std::size_t> open = runs_to_make(directory, runs, force);
    if (!open.empty() || replaces) remove_outdated(directory, runs);
    if (replaces) remove_other_runs(directory, runs);
    write_file(directory / experiment_file, described);
    std::error_code error;
    fs::create_directories(directory / "runs", error);
    if (error) throw InputError("output directory '" + directory.string() + "' cannot be written to");
    return open;
  }
};

// Chooses the steps that an experiment leaves to the program and expands it anew. The leading process
// chooses, and all processes take what it has chosen. False where it was asked to stop before that.
bool choose_steps(Experiment& experiment, std::vector<ExperimentRun>& runs, References& references,
                  Team& team, const ExperimentProgress& progress) {
  const std::vector<const ExperimentRun*> pairs = runs_with_automatic_steps(runs);
  if (pairs.empty()) return true;
  // A list for all pairs: how many steps there are of each, and their numbers.
  const std::vector<std::size_t> list = team.agreed([&] {
    if (progress) progress({1, "choosing steps", 0, pairs.size()});
    std::vector<std::size_t> flat;
    try {
      for (const std::vector<std::int64_t>& of_pair : automatic_step_counts(experiment, pairs, references)) {
        flat.push_back(of_pair.size());
        flat.insert(flat.end(), of_pair.begin(), of_pair.end());
      }
    } catch (const BudgetSpent& spent) {
      if (!spent.stopped()) throw;  // an empty list says to all processes that it was
    }
    return flat;
  });
  if (list.empty()) return false;
  auto next = list.begin();
  for (const ExperimentRun* run : pairs) {
    const auto one = std::find_if(experiment.cases.begin(), experiment.cases.end(),
                                  [&](const ExperimentCase& c) { return &c == run->which; });
    std::vector<std::string>& steps = one->chosen[run->method->label];
    for (std::size_t left = *next++; left > 0; --left)
      steps.push_back(step_of_count(*run, static_cast<std::int64_t>(*next++)));
  }
  runs = expand(experiment);
  return true;
}

// Makes the run and leaves it in the directory; false where it was asked to stop before its end.
bool made(const ExperimentRun& run, References& references, const fs::path& directory) try {
  return make_run(directory / "runs" / run.slug, run.resolved, references.of(run));
} catch (const BudgetSpent& spent) {
  if (!spent.stopped()) throw;
  return false;
}

// The first quantity that is conserved in all runs of a case; empty where there is none.
std::string conserved_in(const ExperimentCase& one, const std::vector<ExperimentRun>& all) {
  std::vector<const ExperimentRun*> runs;
  for (const ExperimentRun& run : all)
    if (run.which == &one) runs.push_back(&run);
  const auto conserves = [](const ExperimentRun* run, const std::string& name) {
    const std::vector<Invariant>& of_run = run->resolved.model->invariants();
    return std::any_of(of_run.begin(), of_run.end(), [&](const Invariant& i) {
      return i.name == name && i.behaviour == Behaviour::conserved;
    });
  };
  for (const Invariant& i : runs.front()->resolved.model->invariants())
    if (std::all_of(runs.begin(), runs.end(),
                    [&](const ExperimentRun* run) { return conserves(run, i.name); }))
      return i.name;
  return {};
}

// Makes all that belongs to the experiment and is not there yet. `done` is the number of runs that are there.
// BudgetSpent where it was asked to stop; what is whole stays. `experiment` gets the steps and the
// conserved quantities that are chosen.
void make_all(Experiment experiment, const fs::path& directory, const ExperimentProgress& progress,
              const ExperimentOptions& options, ExperimentOutcome& outcome, std::size_t& done) {
  std::vector<ExperimentRun> runs = expand(experiment, &outcome.left_out);
  for (ExperimentCase& one : experiment.cases)
    if (one.conserved.empty()) one.conserved = conserved_in(one, runs);
  ThisProcess alone;
  Team& team = options.team == nullptr ? alone : *options.team;
  Preparation ready;
  (void)team.agreed([&] {
    ready.take(experiment, directory, runs, outcome.left_out, options.force);
    return std::vector<std::size_t>();
  });
  References references;
  if (!choose_steps(experiment, runs, references, team, progress)) {
    outcome.interrupted = true;
    return;
  }
  const std::vector<std::size_t> open =
      team.agreed([&] { return ready.find(directory, runs, options.force); });
  outcome.runs = runs.size();
  done = outcome.resumed = runs.size() - open.size();

  const auto report = [&](int phase, const std::string& what, std::size_t number) {
    if (progress) progress({phase, what, number, runs.size()});
  };
  if (!team.several())  // all cores then share one solution; processes make their own when they need it
    for (const std::size_t k : open) {
      report(1, "reference solution of " + runs[k].which->name, outcome.resumed);
      (void)references.of(runs[k]);
    }
  team.share(
      open.size(),
      [&](std::size_t k) {
        const Budget of_this_thread({}, options.stop);
        return made(runs[open[k]], references, directory);
      },
      [&](std::size_t k) { report(1, in_words(runs[open[k]]), ++done); });
  outcome.interrupted = done < runs.size();
  if (!team.leads()) return;
  // Whoever takes the outcome may go on to write into the directory.
  outcome.held = std::move(ready.held);
  if (outcome.interrupted) return;
  write_costs(directory, runs, options.timing.value_or(experiment.quick ? 0.05 : 0.3), progress);

  const std::vector<nlohmann::json> summaries = read_summaries(directory, runs);
  for (const nlohmann::json& s : summaries)
    if (s["status"] != "converged") ++outcome.failed;
  write_file(directory / results_file, results_csv(runs, summaries, runs));
  write_or_remove(directory / ensembles_file, ensembles_csv(runs, summaries));
  report(ExperimentStage::phases, "measures", 0);
  std::string notes;  // on tables
  write_measures(directory, experiment, runs, summaries, references, notes);
  const std::vector<Finding> findings = findings_of(experiment, runs, summaries);
  write_or_remove(directory / findings_file, findings.empty() ? "" : findings_csv(findings));
  for (const Finding& finding : findings) outcome.findings.push_back(to_json(finding));
  outcome.failed_claims = failed_claims(findings);
  write_equal_cost(directory, experiment, runs, summaries, references, progress);
  outcome.table = results_table(directory, experiment, runs, summaries) + findings_table(findings) +
                  said_of_problems(runs, summaries) + notes;
  if (options.report) {
    report(ExperimentStage::phases, "figures and report", 0);
    outcome.report = make_report(directory);
  }
}
}  // namespace

bool make_run(const fs::path& directory, const ResolvedRun& run, const ReferenceSolution* reference) {
  const fs::path unfinished = directory.string() + ".part";
  std::error_code error;
  fs::remove_all(unfinished, error);
  fs::create_directories(unfinished, error);
  const bool whole = write_run(unfinished, run, reference)["status"] != "interrupted";
  fs::remove_all(whole ? directory : unfinished, error);
  if (whole) rename_directory(unfinished, directory);
  return whole;
}

ExperimentOutcome run_experiment(const Experiment& asked, const fs::path& directory,
                                 const ExperimentProgress& progress, const ExperimentOptions& options) {
  if (asked.derivation) {
    if (options.team != nullptr && !options.team->leads()) return {};  // one process makes all of it
    return studies().derivation_growth(
        asked, directory,
        [&](const std::string& what, std::size_t done, std::size_t all) {
          if (progress) progress({1, what, done, all});
        },
        options);
  }
  const Budget budget({}, options.stop);
  ExperimentOutcome outcome;
  std::size_t done = 0;
  try {
    make_all(asked, directory, progress, options, outcome, done);
  } catch (const BudgetSpent& spent) {
    if (!spent.stopped()) throw;
    outcome.interrupted = true;
  }
  if (outcome.interrupted) outcome.resumed = done;
  return outcome;
}

}  // namespace pfaff
