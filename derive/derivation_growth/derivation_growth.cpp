#include <pfaff/derive/derivation_growth/derivation_growth.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>

#include <pfaff/bench/experiment/citations.hpp>
#include <pfaff/bench/experiment/costs.hpp>
#include <pfaff/bench/experiment/experiment_directory.hpp>
#include <pfaff/bench/experiment/results.hpp>
#include <pfaff/bench/runner/files.hpp>
#include <pfaff/derive/derivation/derivation.hpp>
#include <pfaff/derive/derivation_growth/derived_sizes.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff {

namespace fs = std::filesystem;

namespace {

nlohmann::json json_of_derived(const Derived& d) {
  nlohmann::json j{{"schema", 1},           {"method", d.method},         {"size", d.size},
                   {"constraints", d.rods}, {"equations", d.equations},   {"operations", d.operations},
                   {"nodes", d.nodes},      {"tree_operations", nullptr}, {"seconds", d.seconds}};
  if (std::isfinite(d.tree)) j["tree_operations"] = d.tree;
  return j;
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Derived derived(const DerivationStudy& study, const std::string& method, const std::string& size) {
  Assignments settings = study.set;
  settings.emplace_back(study.parameter, size);
  const std::shared_ptr<const Model> model = system_named(study.system).make(settings);
  Derived result{.method = method, .size = size};
  result.seconds = HUGE_VAL;
  double all = 0;
  // Quick derivations are repeated, because the first one also warms the processor's memory.
  constexpr double enough = 0.03;
  constexpr int most = 10;
  for (int k = 0; k < most && all < enough; ++k) {
    const double begin = processor_seconds();
    const Equations equations = derive(*model, method, FrictionForm::none);
    const double taken = processor_seconds() - begin;
    all += taken;
    result.seconds = std::min(result.seconds, taken);
    result.equations = equations.coordinates.size();
    result.operations = operations(equations.tape);
    result.nodes = equations.tape.code.size();
    result.tree = tree_operations(equations.tape);
  }
  result.rods = model->source().constraint_names.size();
  return result;
}

// A derivation that the directory holds, whole and with numbers that a derivation can have.
std::optional<Derived> kept(const fs::path& file, const std::string& method, const std::string& size) {
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  nlohmann::json j = nlohmann::json::parse(read_file(file), nullptr, false);
  if (!j.is_object() || j["method"] != method || j["size"] != size) return std::nullopt;
  for (const char* key : {"constraints", "equations", "operations", "nodes"})
    if (!j[key].is_number_unsigned()) return std::nullopt;
  if (!j["seconds"].is_number() || !plausible_seconds(j["seconds"])) return std::nullopt;
  Derived d{.method = method, .size = size};
  d.rods = j["constraints"];
  d.equations = j["equations"];
  d.operations = j["operations"];
  d.nodes = j["nodes"];
  d.seconds = j["seconds"];
  d.tree = j.contains("tree_operations") && j["tree_operations"].is_number()
               ? j["tree_operations"].get<double>()
               : HUGE_VAL;
  return d;
}

nlohmann::json description(const Experiment& experiment) {
  const DerivationStudy& study = *experiment.derivation;
  nlohmann::json j{{"schema", 1},
                   {"kind", "derivation"},
                   {"name", experiment.name},
                   {"title", experiment.title},
                   {"description", experiment.description},
                   {"reference", experiment.reference},
                   {"citation", nlohmann::json::array()},
                   {"notes", experiment.notes},
                   {"quick", experiment.quick},
                   {"versions", versions()},
                   {"system", study.system},
                   {"parameter", study.parameter},
                   {"parameters", nlohmann::json::object()},
                   {"seconds", study.seconds},
                   {"fit_from", study.fit_from},
                   {"methods", nlohmann::json::array()},
                   {"published", nlohmann::json::array()}};
  for (const std::string& key : experiment.reference) j["citation"].push_back(citation(key));
  for (const auto& [key, value] : study.set) j["parameters"][key] = value;
  for (const DerivationSweep& sweep : study.sweeps)
    j["methods"].push_back(
        {{"name", sweep.method}, {"title", derivation_method(sweep.method).title}, {"sizes", sweep.sizes}});
  for (const PublishedTime& p : study.published)
    j["published"].push_back({{"label", p.label}, {"factor", p.factor}, {"rate", p.rate}});
  return j;
}

// Refuses a directory with another experiment, or with one that another build made; with `force` they are
// removed.
void check_identity(const fs::path& directory, const nlohmann::json& mine, bool force) {
  const fs::path identity = directory / experiment_file;
  std::error_code error;
  if (!fs::exists(identity, error)) return;
  nlohmann::json theirs = nlohmann::json::parse(read_file(identity), nullptr, false);
  if (!theirs.is_object() || !theirs.contains("schema")) return;
  const bool same_build = theirs["versions"] == mine["versions"];
  theirs["versions"] = mine["versions"];
  refuse_another_experiment(directory, theirs, mine, force);
  if (!same_build && !force)
    throw InputError("output directory '" + directory.string() +
                     "' holds derivations by another build of Pfaff; expected a new directory, or --force to "
                     "make them anew");
  if (same_build && !force) return;
  fs::remove_all(directory / "runs", error);
}

}  // namespace

ExperimentOutcome derivation_growth(
    const Experiment& experiment, const fs::path& directory,
    const std::function<void(const std::string& what, std::size_t done, std::size_t all)>& progress,
    const ExperimentOptions& options) {
  const DerivationStudy& study = *experiment.derivation;
  // Every size is made once before anything is derived, so that mistakes are found first.
  for (const DerivationSweep& sweep : study.sweeps)
    for (const std::string& size : sweep.sizes) {
      Assignments settings = study.set;
      settings.emplace_back(study.parameter, size);
      const auto model = system_named(study.system).make(settings);
      if (const std::string reason = derivation_misfit(*model, sweep.method); !reason.empty())
        throw InputError(experiment.name + ": " + reason);
    }
  const nlohmann::json described = description(experiment);
  ExperimentOutcome outcome;
  outcome.held = take_experiment_directory(directory, "pfaff compare");
  check_identity(directory, described, options.force);
  write_file(directory / experiment_file, described.dump(1) + "\n");
  std::vector<Derived> all;
  std::size_t done = 0;
  for (const DerivationSweep& sweep : study.sweeps)
    for (const std::string& size : sweep.sizes) {
      const fs::path run = directory / "runs" / (sweep.method + "-" + size);
      const fs::path file = run / "summary.json";
      if (progress)
        progress("method " + sweep.method + ", " + study.parameter + " " + size, done, study.size());
      ++done;
      const std::optional<Derived> before = kept(file, sweep.method, size);
      outcome.resumed += before.has_value() ? 1 : 0;
      all.push_back(before ? *before : derived(study, sweep.method, size));
      if (!before) {
        std::error_code error;
        remove_derived(directory);
        fs::remove(directory / "cost.csv", error);
        fs::create_directories(run, error);
        write_file(file, json_of_derived(all.back()).dump(1) + "\n");
      }
      if (all.back().seconds > study.seconds) {
        done += static_cast<std::size_t>(&sweep.sizes.back() - &size);
        break;
      }
    }
  outcome.runs = all.size();
  const std::vector<Fit> fits = fits_of(study, all);
  write_derivation_tables(directory, all, fits);
  judge_derivations(study, fits, outcome);
  outcome.table = derivation_table(study, all, fits);
  if (options.report) {
    if (progress) progress("figures and report", study.size(), study.size());
    outcome.report = make_report(directory);
  }
  return outcome;
}

}  // namespace pfaff
