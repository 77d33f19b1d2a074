#include <pfaff/bench/runner/experiment.hpp>

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <mutex>

#include <pfaff/bench/measure/scope.hpp>
#include <pfaff/bench/runner/citations.hpp>
#include <pfaff/bench/runner/costs.hpp>
#include <pfaff/bench/runner/experiment_findings.hpp>
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
                          {"reference_solution", !c.reference                   ? "none"
                                                 : f.has(Facet::exact_solution) ? "exact"
                                                                                : "30-digit"}});
    if (c.seeds > 0) j["cases"].back()["seeds"] = c.seeds;
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
    if (!m.tolerances.empty()) j["methods"].back()["tolerances"] = m.tolerances;
    if (!run->resolved.settings.formulation.empty()) {
      j["methods"].back()["formulation"] = run->resolved.settings.formulation;
      for (const auto& [key, value] : run->resolved.model->source().formulation_parameters)
        j["methods"].back()["parameters"]["formulation." + key] = value;
    }
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
  settings.step = run.step;
  settings.tolerance = run.tolerance;
  settings.time = c.time;
  settings.precision = c.precision;
  try {
    ResolvedRun result = resolve(settings);
    result.structure_residuals = c.structure && run.seed == 0;
    // Many runs are kept: fewer samples of each.
    constexpr std::int64_t ensemble_samples = 200;
    if (run.seed > 0 && !result.adaptive())
      result.every = std::max<std::int64_t>(1, (result.steps + ensemble_samples - 1) / ensemble_samples);
    return result;
  } catch (const InputError& error) {
    throw InputError(experiment.name + ", case " + c.name + ", method " + m.label + ": " + error.what());
  }
}

void check_conserved(const Experiment& experiment, const ExperimentCase& c, const ExperimentRun& run) {
  std::vector<std::string> names;
  for (const Invariant& i : run.resolved.model->invariants()) names.push_back(i.name);
  if (!c.conserved.empty() && std::find(names.begin(), names.end(), c.conserved) == names.end())
    throw InputError(experiment.name + ", case " + c.name + ": " +
                     unknown_name("invariant", c.conserved, names));
}

// What a run is compared with: one solution for all runs of a case, and of a seed where it has seeds.
std::pair<const ExperimentCase*, int> problem_of(const ExperimentRun& run) { return {run.which, run.seed}; }

std::unique_ptr<ReferenceSolution> reference_of(const ExperimentRun& run) {
  std::vector<Quad> initial;
  for (const Real& x : run.resolved.initial) initial.push_back(x.quad());
  // Methods on the constraints have a model without a vector field: its motion has one.
  std::shared_ptr<const Model> model = run.resolved.model;
  if (!model->facets().has(Facet::exact_solution) && !model->facets().has(Facet::vector_field))
    model = formulations().get("dirac", "formulation").apply(model, {});
  return std::make_unique<ReferenceSolution>(model, run.resolved.t0.quad(), initial,
                                             run.resolved.time.quad());
}
}  // namespace

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
    check_conserved(experiment, c, runs.back());
  }
  // Runs are kept by this name: two of the same would overwrite each other.
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

  std::map<std::pair<const ExperimentCase*, int>, std::unique_ptr<ReferenceSolution>> references;
  for (const ExperimentRun* run : open)
    if (auto& slot = references[problem_of(*run)]; slot == nullptr && run->which->reference) {
      if (progress) progress("reference solution of " + run->which->name, outcome.resumed, runs.size());
      slot = reference_of(*run);
    }
  std::mutex mutex;
  std::size_t done = outcome.resumed;
  oneapi::tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t k) {
    const ExperimentRun& run = *open[k];
    const RunRecord record = execute(run.resolved, references.at(problem_of(run)).get());
    leave(directory / "runs" / run.slug, run.resolved, config_text(run.resolved), record, run);
    const std::lock_guard lock(mutex);
    if (progress) progress(in_words(run), ++done, runs.size());
  });

  const std::vector<nlohmann::json> summaries = read_summaries(directory, runs);
  for (const nlohmann::json& s : summaries)
    if (s["status"] != "converged") ++outcome.failed;
  write_file(directory / "results.csv", results_csv(runs, summaries));
  if (const std::string text = ensembles_csv(runs, summaries); !text.empty())
    write_file(directory / "ensembles.csv", text);
  const std::vector<Finding> findings = findings_of(experiment, runs, summaries);
  if (!findings.empty()) write_file(directory / "findings.csv", findings_csv(findings));
  for (const Finding& finding : findings) outcome.findings.push_back(to_json(finding));
  outcome.failed_claims = failed_claims(findings);
  write_costs(directory, experiment, runs, progress);
  outcome.table = results_table(directory, experiment, runs, summaries) + findings_table(findings);
  if (progress) progress("figures and report", runs.size(), runs.size());
  outcome.report = make_report(directory);
  return outcome;
}

}  // namespace pfaff
