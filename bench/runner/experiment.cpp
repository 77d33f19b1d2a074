#include <pfaff/bench/runner/experiment.hpp>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <mutex>

#include <pfaff/bench/measure/scope.hpp>
#include <pfaff/bench/runner/citations.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/bench/runner/results.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {
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
  j["citation"] = nlohmann::json::array();
  for (const std::string& key : experiment.reference) j["citation"].push_back(citation(key));
  for (const ExperimentCase& c : experiment.cases) {
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.which == &c; });
    const Model& model = *run->resolved.model;
    nlohmann::json parameters = nlohmann::json::object();
    for (const auto& [key, value] : model.parameters()) parameters[key] = value;
    const FacetSet f = model.facets();
    j["cases"].push_back({{"name", c.name},
                          {"title", c.title},
                          {"system", c.system},
                          {"parameters", parameters},
                          {"time", to_string(run->resolved.time)},
                          {"time_unit", model.time_unit()},
                          {"precision", to_string(c.precision)},
                          {"conserved", c.conserved},
                          {"structure", f.has(Facet::structure)     ? nlohmann::json("K-symplectic")
                                        : f.has(Facet::hamiltonian) ? nlohmann::json("symplectic")
                                                                    : nlohmann::json(nullptr)},
                          {"reference_solution", f.has(Facet::exact_solution) ? "exact" : "30-digit"}});
  }
  for (const ExperimentMethod& m : experiment.methods) {
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.method == &m; });
    if (run == runs.end()) continue;
    nlohmann::json parameters = nlohmann::json::object(), systems = nlohmann::json::array();
    for (const auto& [key, value] : run->resolved.method->parameters()) parameters[key] = value;
    // What is claimed of each system, as `describe` says it: order and claims may depend on the problem.
    std::vector<std::string> seen;
    for (const ExperimentRun& r : runs) {
      if (r.method != &m || std::find(seen.begin(), seen.end(), r.which->system) != seen.end()) continue;
      seen.push_back(r.which->system);
      nlohmann::json claims = nlohmann::json::array();
      for (const Claim claim : claims_in_scope(*r.resolved.method, *r.resolved.model))
        claims.push_back(to_string(claim));
      systems.push_back({{"name", r.which->system},
                         {"order", r.resolved.method->order(*r.resolved.model)},
                         {"preserves", claims}});
    }
    j["methods"].push_back(
        {{"label", m.label}, {"integrator", m.integrator}, {"parameters", parameters}, {"systems", systems}});
  }
  return j;
}

// A run is done when its directory holds a whole summary made from the same settings.
bool done_already(const fs::path& directory, const std::string& config) {
  std::error_code error;
  return fs::exists(directory / "summary.json", error) && fs::exists(directory / "config.toml", error) &&
         read_file(directory / "config.toml") == config &&
         nlohmann::json::accept(read_file(directory / "summary.json"));
}

void leave(const fs::path& directory, const ResolvedRun& run, const std::string& config,
           const RunRecord& record, const ExperimentRun& which) {
  const fs::path unfinished = directory.string() + ".part";
  std::error_code error;
  fs::remove_all(unfinished, error);
  fs::remove_all(directory, error);
  fs::create_directories(unfinished, error);
  nlohmann::json j = summary(run, record);
  j["case"] = which.which->name;
  j["method"] = which.method->label;
  write_file(unfinished / "config.toml", config);
  write_file(unfinished / "series.csv", series_csv(run, record));
  write_file(unfinished / "summary.json", j.dump(1) + "\n");
  fs::rename(unfinished, directory, error);
  if (error) throw RunError("cannot write " + directory.string() + ": " + error.message());
}
}  // namespace

std::vector<ExperimentRun> expand(const Experiment& experiment) {
  std::vector<ExperimentRun> runs;
  for (const ExperimentCase& c : experiment.cases)
    for (const ExperimentMethod& m : experiment.methods) {
      if (!c.methods.empty() && std::find(c.methods.begin(), c.methods.end(), m.label) == c.methods.end())
        continue;
      for (const std::string& step : c.steps) {
        ExperimentRun run{&c, &m, step, slug_of(c.name + "-" + m.label + "-h" + step), {}};
        RunSettings settings;
        settings.system = c.system;
        settings.integrator = m.integrator;
        settings.formulation = m.formulation;
        for (const auto& [key, value] : c.set) settings.set.emplace_back("system." + key, value);
        for (const auto& [key, value] : m.set)
          settings.set.emplace_back(key.starts_with("formulation.") ? key : "integrator." + key, value);
        settings.initial = c.initial;
        settings.step = step;
        settings.time = c.time;
        settings.precision = c.precision;
        try {
          run.resolved = resolve(settings);
        } catch (const InputError& error) {
          throw InputError(experiment.name + ", case " + c.name + ", method " + m.label + ": " +
                           error.what());
        }
        const auto& invariants = run.resolved.model->invariants();
        std::vector<std::string> names;
        for (const Invariant& i : invariants) names.push_back(i.name);
        if (!c.conserved.empty() && std::find(names.begin(), names.end(), c.conserved) == names.end())
          throw InputError(experiment.name + ", case " + c.name + ": " +
                           unknown_name("invariant", c.conserved, names));
        // Runs are kept by this name: two of the same would overwrite each other.
        for (const ExperimentRun& other : runs)
          if (other.slug == run.slug)
            throw InputError(experiment.name + ": case " + c.name + ", method " + m.label + ", step " + step +
                             " and case " + other.which->name + ", method " + other.method->label +
                             ", step " + other.step + " would share the directory runs/" + run.slug +
                             "; expected different names");
        runs.push_back(std::move(run));
      }
    }
  return runs;
}

ExperimentOutcome run_experiment(const Experiment& experiment, const fs::path& directory,
                                 const ExperimentProgress& progress) {
  const std::vector<ExperimentRun> runs = expand(experiment);
  const std::string described = description(experiment, runs).dump(1) + "\n";
  std::error_code error;
  const fs::path identity = directory / "experiment.json";
  if (fs::exists(identity, error)) {
    // The same experiment by another build is resumed too: runs are compared by their own settings.
    nlohmann::json mine = nlohmann::json::parse(described);
    nlohmann::json theirs = nlohmann::json::parse(read_file(identity), nullptr, false);
    if (theirs.is_object()) theirs["versions"] = mine["versions"];
    if (theirs != mine)
      throw InputError(
          "output directory '" + directory.string() +
          "' holds another experiment; expected a new directory or the same experiment to resume");
  } else {
    make_output_directory(directory);
  }
  write_file(identity, described);
  fs::create_directories(directory / "runs", error);
  if (error) throw InputError("output directory '" + directory.string() + "' cannot be written to");

  ExperimentOutcome outcome;
  outcome.runs = runs.size();
  std::vector<const ExperimentRun*> open;
  for (const ExperimentRun& run : runs) {
    if (done_already(directory / "runs" / run.slug, config_text(run.resolved))) {
      ++outcome.resumed;
    } else {
      open.push_back(&run);
    }
  }

  // One reference solution a case, shared by its runs.
  std::map<const ExperimentCase*, std::unique_ptr<ReferenceSolution>> references;
  for (const ExperimentRun* run : open)
    if (auto& slot = references[run->which]; slot == nullptr) {
      std::vector<Quad> initial;
      for (const Real& x : run->resolved.initial) initial.push_back(x.quad());
      if (progress) progress("reference solution of " + run->which->name, outcome.resumed, runs.size());
      slot = std::make_unique<ReferenceSolution>(run->resolved.model, run->resolved.t0.quad(), initial,
                                                 run->resolved.time.quad());
    }
  std::mutex mutex;
  std::size_t done = outcome.resumed;
  oneapi::tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t k) {
    const ExperimentRun& run = *open[k];
    const RunRecord record = execute(run.resolved, references.at(run.which).get());
    leave(directory / "runs" / run.slug, run.resolved, config_text(run.resolved), record, run);
    const std::lock_guard lock(mutex);
    if (progress)
      progress(run.which->name + ", " + run.method->label + ", h = " + run.step, ++done, runs.size());
  });

  const std::vector<nlohmann::json> summaries = read_summaries(directory, runs);
  for (const nlohmann::json& s : summaries)
    if (s["status"] != "converged") ++outcome.failed;
  write_file(directory / "results.csv", results_csv(runs, summaries));
  write_costs(directory, experiment, runs, progress);
  outcome.table = results_table(directory, experiment, runs, summaries);
  if (progress) progress("figures and report", runs.size(), runs.size());
  outcome.report = make_report(directory);
  return outcome;
}

}  // namespace pfaff
