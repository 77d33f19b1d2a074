#include <pfaff/bench/experiment/experiment.hpp>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include <pfaff/bench/experiment/citations.hpp>
#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/equal_cost.hpp>
#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/directory_lock.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/run_directory.hpp>
#include <pfaff/core/text/source.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
constexpr const char* experiment_file = "experiment.json";

std::string slug_of(const std::string& text) {
  std::string slug;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.';
    if (plain) {
      slug += c;
    } else if (c >= 'A' && c <= 'Z') {
      slug += static_cast<char>(c - 'A' + 'a');
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  return slug;
}

nlohmann::json description(const Experiment& experiment, const std::vector<ExperimentRun>& runs) {
  nlohmann::json j{{"schema", 1},
                   {"name", experiment.name},
                   {"title", experiment.title},
                   {"description", experiment.description},
                   {"reference", experiment.reference},
                   {"notes", experiment.notes},
                   {"quick", experiment.quick},
                   {"versions", versions()}};
  if (experiment.compile) j["compile"] = true;
  for (const DriftClassEntry& entry : drift_classes())
    j["drift_classes"].push_back({{"name", entry.name},
                                  {"meaning", entry.meaning},
                                  {"measure", entry.measure},
                                  {"grows", entry.grows}});
  j["citation"] = nlohmann::json::array();
  for (const std::string& key : experiment.reference) j["citation"].push_back(citation(key));
  for (const ExperimentCase& c : experiment.cases) {
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.which == &c; });
    const Model& model = *run->resolved.model;
    nlohmann::json parameters = nlohmann::json::object();
    for (const auto& [key, value] : model.parameters()) parameters[key] = value;
    nlohmann::json structure;  // null where there is none to keep
    if (const auto name = structure_name(model); !name.empty()) structure = name;
    const bool exact = model.facets().has(Facet::exact_solution);
    j["cases"].push_back({{"name", c.name},
                          {"title", c.title},
                          {"system", c.system},
                          {"parameters", parameters},
                          {"time", to_string(run->resolved.time)},
                          {"time_unit", model.time_unit()},
                          {"precision", to_string(c.precision)},
                          {"conserved", c.conserved},
                          {"motion", c.motion},
                          {"structure", structure},
                          {"reference_solution", !c.reference ? "none"
                                                 : exact      ? "exact"
                                                              : "30-digit"}});
    if (c.seeds > 0) j["cases"].back()["seeds"] = c.seeds;
  }
  for (const ExperimentMethod& m : experiment.methods) {
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.method == &m; });
    if (run == runs.end()) continue;
    nlohmann::json parameters = nlohmann::json::object(), systems = nlohmann::json::array();
    for (const auto& [key, value] : run->resolved.method->parameters()) parameters[key] = value;
    // The order and claims of a method on each system, as `describe` gives them; they are listed per system
    // because they may depend on the problem.
    std::vector<std::string> seen;
    for (const ExperimentRun& r : runs) {
      if (r.method != &m || std::find(seen.begin(), seen.end(), r.which->system) != seen.end()) continue;
      seen.push_back(r.which->system);
      nlohmann::json claims = nlohmann::json::array();
      const Model& model = *r.resolved.model;
      for (const Claim claim : claims_in_scope(r.resolved.method->preserves(model), model))
        claims.push_back(to_string(claim));
      systems.push_back({{"name", r.which->system},
                         {"order", r.resolved.method->order(*r.resolved.model)},
                         {"preserves", claims}});
    }
    j["methods"].push_back(
        {{"label", m.label}, {"integrator", m.integrator}, {"parameters", parameters}, {"systems", systems}});
    if (!m.tolerances.empty()) j["methods"].back()["tolerances"] = m.tolerances;
    if (!run->resolved.settings.formulation.empty()) {
      j["methods"].back()["formulation"] = run->resolved.settings.formulation;
      for (const auto& [key, value] : run->resolved.model->source().formulation_parameters)
        j["methods"].back()["parameters"]["formulation." + key] = value;
    }
  }
  return j;
}

std::string in_words(const ExperimentRun& run) {
  return "case " + run.which->name + ", method " + run.method->label +
         (run.tolerance.empty() ? ", step " + run.step : ", tolerance " + run.tolerance);
}

ResolvedRun resolved(const Experiment& experiment, const ExperimentRun& run) {
  const ExperimentCase& c = *run.which;
  const ExperimentMethod& m = *run.method;
  RunSettings settings;
  settings.system = c.system;
  settings.integrator = m.integrator;
  settings.formulation = m.formulation;
  for (const auto& [key, value] : c.set) settings.set.emplace_back("system." + key, value);
  if (run.seed > 0) settings.set.emplace_back("system.seed", std::to_string(run.seed));
  for (const auto& [key, value] : m.set)
    settings.set.emplace_back(key.starts_with("formulation.") ? key : "integrator." + key, value);
  settings.initial = c.initial;
  settings.compile = experiment.compile;
  settings.step = run.step;
  settings.tolerance = run.tolerance;
  settings.time = c.time;
  settings.precision = c.precision;
  settings.reference = c.reference ? ErrorsAgainst::solution : ErrorsAgainst::none;
  settings.structure_residuals = c.structure && run.seed == 0;
  settings.of_case = c.name;
  settings.of_method = m.label;
  const std::string where = experiment.name + ", case " + c.name + ", method " + m.label + ": ";
  try {
    ResolvedRun result = resolve(settings);
    // An ensemble keeps many runs, and so fewer samples of each.
    constexpr std::int64_t ensemble_samples = 200;
    if (run.seed > 0 && !result.adaptive())
      result.every = std::max<std::int64_t>(1, (result.steps + ensemble_samples - 1) / ensemble_samples);
    return result;
  } catch (const text::TextError& error) {
    throw text::TextError(where + error.what(), error.excerpt());
  } catch (const InputError& error) {
    throw InputError(where + error.what());
  }
}

void check_names(const Experiment& experiment, const ExperimentCase& c, const ExperimentRun& run) {
  std::vector<std::string> names, coordinates;
  for (const Invariant& i : run.resolved.model->invariants()) names.push_back(i.name);
  if (!c.conserved.empty() && std::find(names.begin(), names.end(), c.conserved) == names.end())
    throw InputError(experiment.name + ", case " + c.name + ": " +
                     unknown_name("invariant", c.conserved, names));
  for (const Coordinate& x : run.resolved.model->coordinates()) coordinates.push_back(x.name);
  for (const std::string& name : c.motion)
    if (std::find(coordinates.begin(), coordinates.end(), name) == coordinates.end())
      throw InputError(experiment.name + ", case " + c.name + ": " +
                       unknown_name("coordinate", name, coordinates));
}
}  // namespace

void leave(const fs::path& directory, const ResolvedRun& run, const RunRecord& record) {
  const fs::path unfinished = directory.string() + ".part";
  std::error_code error;
  fs::remove_all(unfinished, error);
  fs::create_directories(unfinished, error);
  (void)write_run(unfinished, run, record);
  fs::remove_all(directory, error);
  rename_directory(unfinished, directory);
}

ProblemKey problem_of(const ExperimentRun& run) {
  const Model& model = *run.resolved.model;
  return {run.which, run.seed, model.restricted() ? std::string() : model.source().formulation};
}

ExperimentRun at_size(const Experiment& experiment, const ExperimentRun& like, const std::string& size) {
  ExperimentRun run{like.which, like.method, {}, {}, like.seed, {}, {}};
  (like.tolerance.empty() ? run.step : run.tolerance) = size;
  run.slug = slug_of(like.which->name + "-" + like.method->label);
  run.resolved = resolved(experiment, run);
  return run;
}

std::vector<ExperimentRun> expand(const Experiment& experiment) {
  std::vector<ExperimentRun> runs;
  for (const ExperimentCase& c : experiment.cases) {
    for (const ExperimentMethod& m : experiment.methods) {
      if (!takes(c, m)) continue;
      const bool adaptive = !m.tolerances.empty();
      for (const std::string& size : adaptive ? m.tolerances : c.steps)
        for (int seed = c.seeds > 0 ? 1 : 0; seed <= c.seeds; ++seed) {
          ExperimentRun run{&c, &m, adaptive ? "" : size, adaptive ? size : "", seed, {}, {}};
          run.slug = slug_of(c.name + "-" + m.label + (adaptive ? "-tol" : "-h") + size +
                             (seed > 0 ? "-seed" + std::to_string(seed) : ""));
          run.resolved = resolved(experiment, run);
          runs.push_back(std::move(run));
        }
    }
    check_names(experiment, c, runs.back());
  }
  // The slug names the directory of a run; two runs with the same slug would overwrite each other.
  std::map<std::string, const ExperimentRun*> kept;
  for (const ExperimentRun& run : runs) {
    const auto [other, fresh] = kept.emplace(run.slug, &run);
    if (!fresh)
      throw InputError(experiment.name + ": " + in_words(*other->second) + " and " + in_words(run) +
                       " would share the directory runs/" + run.slug + "; expected different names");
  }
  check_claims(experiment, runs);
  return runs;
}

namespace {
// Refuses a directory that holds another experiment than the one described.
void check_identity(const fs::path& directory, const nlohmann::json& mine) {
  const fs::path identity = directory / experiment_file;
  std::error_code error;
  if (!fs::exists(identity, error)) return;
  // Builds are left out of the comparison here; they belong to the identity of each run.
  nlohmann::json theirs = nlohmann::json::parse(read_file(identity), nullptr, false);
  // A damaged file says nothing about the runs beside it, each of which says by itself what it is.
  if (!theirs.is_object() || !theirs.contains("schema")) return;
  const nlohmann::json their_classes = theirs["drift_classes"];
  theirs["versions"] = mine["versions"];
  theirs["drift_classes"] = mine["drift_classes"];
  if (theirs != mine)
    throw InputError("output directory '" + directory.string() +
                     "' holds another experiment; expected a new directory or the same experiment to resume");
  if (their_classes != mine["drift_classes"])
    throw InputError("output directory '" + directory.string() +
                     "' holds runs of a version with other drift classes; expected a new directory");
}

// The runs that `directory` does not hold. Refuses outdated runs unless they may be made anew.
std::vector<const ExperimentRun*> runs_to_make(const fs::path& directory,
                                               const std::vector<ExperimentRun>& runs, bool force) {
  std::vector<const ExperimentRun*> open;
  std::vector<std::string> changed;
  for (const ExperimentRun& run : runs) {
    const KeptRun kept = kept_run(directory / "runs" / run.slug, run.resolved);
    if (!kept.current()) open.push_back(&run);
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
  std::error_code error;
  for (const char* name : {"results.csv", "equal_cost.csv", "ensembles.csv", "findings.csv", "report.html"})
    fs::remove(directory / name, error);
}
}  // namespace

ExperimentOutcome run_experiment(const Experiment& experiment, const fs::path& directory,
                                 const ExperimentProgress& progress, bool force) {
  const std::vector<ExperimentRun> runs = expand(experiment);
  const std::string described = description(experiment, runs).dump(1) + "\n";
  std::error_code error;
  if (!fs::exists(directory / experiment_file, error)) make_output_directory(directory, {experiment_file});
  const DirectoryLock held(directory, "pfaff compare");
  check_identity(directory, nlohmann::json::parse(described));
  const std::vector<const ExperimentRun*> open = runs_to_make(directory, runs, force);
  if (!open.empty()) remove_outdated(directory, runs);
  write_file(directory / experiment_file, described);
  fs::create_directories(directory / "runs", error);
  if (error) throw InputError("output directory '" + directory.string() + "' cannot be written to");

  ExperimentOutcome outcome;
  outcome.runs = runs.size();
  outcome.resumed = runs.size() - open.size();
  References references;
  for (const ExperimentRun* run : open)
    if (auto& slot = references[problem_of(*run)]; slot == nullptr && run->which->reference) {
      if (progress) progress("reference solution of " + run->which->name, outcome.resumed, runs.size());
      slot = reference_of(run->resolved);
    }
  std::mutex mutex;
  std::size_t done = outcome.resumed;
  oneapi::tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t k) {
    const ExperimentRun& run = *open[k];
    const RunRecord record = execute(run.resolved, references.at(problem_of(run)).get());
    leave(directory / "runs" / run.slug, run.resolved, record);
    const std::lock_guard lock(mutex);
    if (progress) progress(in_words(run), ++done, runs.size());
  });

  const std::vector<nlohmann::json> summaries = read_summaries(directory, runs);
  for (const nlohmann::json& s : summaries)
    if (s["status"] != "converged") ++outcome.failed;
  write_file(directory / "results.csv", results_csv(runs, summaries));
  write_or_remove(directory / "ensembles.csv", ensembles_csv(runs, summaries));
  const std::vector<Finding> findings = findings_of(experiment, runs, summaries);
  write_or_remove(directory / "findings.csv", findings.empty() ? "" : findings_csv(findings));
  for (const Finding& finding : findings) outcome.findings.push_back(to_json(finding));
  outcome.failed_claims = failed_claims(findings);
  write_costs(directory, experiment, runs, progress);
  write_equal_cost(directory, experiment, runs, summaries, references, progress);
  outcome.table = results_table(directory, experiment, runs, summaries) + findings_table(findings);
  if (progress) progress("figures and report", runs.size(), runs.size());
  outcome.report = make_report(directory);
  return outcome;
}

}  // namespace pfaff
