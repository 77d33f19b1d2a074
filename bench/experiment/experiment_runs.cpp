// The runs that an experiment consists of: every case with every method that takes it, each step or tolerance
// and each seed.
#include <algorithm>
#include <map>

#include <pfaff/bench/experiment/case_frequencies.hpp>
#include <pfaff/bench/experiment/error_measure.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/experiment/experiment_findings.hpp>
#include <pfaff/bench/experiment/method_selection.hpp>
#include <pfaff/core/text/source.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff {

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

ResolvedRun resolved(const Experiment& experiment, const ExperimentRun& run) {
  const ExperimentCase& c = *run.which;
  const ExperimentMethod& m = *run.method;
  RunSettings settings;
  settings.system = c.system;
  settings.integrator = m.integrator;
  settings.method = m.object;
  settings.formulation = m.formulation;
  for (const auto& [key, value] : c.set) settings.set.emplace_back("system." + key, value);
  if (run.seed > 0) settings.set.emplace_back("system.seed", std::to_string(run.seed));
  for (const auto& [key, value] : m.set)
    settings.set.emplace_back(key.starts_with("formulation.") ? key : "integrator." + key, value);
  settings.initial = c.initial;
  settings.initial_velocities = c.initial_velocities;
  settings.compile = experiment.compile;
  settings.step = run.step;
  settings.tolerance = run.tolerance;
  settings.absolute = m.absolute;
  settings.time = c.time;
  settings.precision = c.precision;
  settings.reference = c.reference ? ErrorsAgainst::solution : ErrorsAgainst::none;
  settings.errors_at_every_row = c.errors_at_every_row;
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

// The steps or tolerances of a method in a case. Where steps are still to be chosen, the whole time, one
// step, stands for them.
std::vector<std::string> sizes_of(const ExperimentCase& c, const ExperimentMethod& m) {
  if (!m.tolerances.empty()) return m.tolerances;
  if (!c.automatic) return c.steps;
  const auto chosen = c.chosen.find(m.label);
  return chosen == c.chosen.end() ? std::vector<std::string>{c.time} : chosen->second;
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
  if (c.frequencies.empty()) return;
  try {
    const std::string reason = frequencies_of(c)->refuses(*run.resolved.model, *run.resolved.method);
    if (!reason.empty()) throw InputError(reason);
  } catch (const text::TextError& error) {
    throw text::TextError(experiment.name + ", case " + c.name + ": " + error.what(), error.excerpt());
  } catch (const InputError& error) {
    throw InputError(experiment.name + ", case " + c.name + ": " + error.what());
  }
}

// Motions of the formulations that make an energy of their own have invariants of their own, so that every
// run is looked at.
void check_error(const Experiment& experiment, const ExperimentRun& run) {
  const std::string where =
      experiment.name + ", case " + run.which->name + ", method " + run.method->label + ": ";
  std::string reason;
  try {
    reason = error_refused(*run.which, run.resolved);
  } catch (const InputError& error) {
    reason = error.what();
  }
  if (!reason.empty()) throw InputError(where + "key 'error': " + reason);
}

// The system of a case, before a formulation is applied.
std::shared_ptr<const Model> system_of(const Experiment& experiment, const ExperimentCase& c) {
  try {
    return system_named(c.system).make(c.set);
  } catch (const InputError& error) {
    throw InputError(experiment.name + ", case " + c.name + ": " + error.what());
  }
}

// The methods that the case is run with. What a selection leaves out is added to `left_out`.
std::vector<const ExperimentMethod*> methods_of(const Experiment& experiment, const ExperimentCase& c,
                                                std::vector<LeftOut>& left_out) {
  std::vector<const ExperimentMethod*> methods;
  const std::shared_ptr<const Model> system = experiment.selection ? system_of(experiment, c) : nullptr;
  for (const ExperimentMethod& m : experiment.methods) {
    if (!takes(c, m)) continue;
    const std::string reason =
        m.selected ? reason_to_leave_out(*experiment.selection, m, c, system) : std::string();
    if (reason.empty()) {
      methods.push_back(&m);
    } else {
      left_out.push_back({c.name, m.label, reason});
    }
  }
  if (methods.empty())
    throw InputError(experiment.name + ", case " + c.name + ": none of the methods selected fits; " +
                     left_out.back().method + " " + left_out.back().reason);
  return methods;
}
}  // namespace

std::string in_words(const ExperimentRun& run) {
  return "case " + run.which->name + ", method " + run.method->label +
         (run.tolerance.empty() ? ", step " + run.step : ", tolerance " + run.tolerance);
}

std::string system_name(const ExperimentRun& run) {
  return text::is_text_file(run.which->system) ? run.resolved.model->name() : run.which->system;
}

ExperimentRun at_size(const Experiment& experiment, const ExperimentRun& like, const std::string& size) {
  ExperimentRun run{like.which, like.method, {}, {}, like.seed, {}, {}};
  (like.tolerance.empty() ? run.step : run.tolerance) = size;
  run.slug = slug_of(like.which->name + "-" + like.method->label);
  run.resolved = resolved(experiment, run);
  return run;
}

std::vector<ExperimentRun> expand(const Experiment& experiment, std::vector<LeftOut>* left_out) {
  std::vector<ExperimentRun> runs;
  std::vector<LeftOut> out;
  for (const ExperimentCase& c : experiment.cases) {
    for (const ExperimentMethod* m : methods_of(experiment, c, out)) {
      const bool adaptive = !m->tolerances.empty();
      for (const std::string& size : sizes_of(c, *m))
        for (int seed = c.seeds > 0 ? 1 : 0; seed <= c.seeds; ++seed) {
          ExperimentRun run{&c, m, adaptive ? "" : size, adaptive ? size : "", seed, {}, {}};
          run.slug = slug_of(c.name + "-" + m->label + (adaptive ? "-tol" : "-h") + size +
                             (seed > 0 ? "-seed" + std::to_string(seed) : ""));
          run.resolved = resolved(experiment, run);
          check_error(experiment, run);
          runs.push_back(std::move(run));
        }
    }
    check_names(experiment, c, runs.back());
  }
  if (left_out != nullptr) *left_out = std::move(out);
  // The slug names the directory of a run, and that of the case its figures; two with the same slug would
  // overwrite each other. Names of files have 255 letters at most, of which some are taken by what is put
  // before and behind a slug.
  constexpr std::size_t longest = 200;
  std::map<std::string, std::string> cases;
  for (const ExperimentCase& c : experiment.cases)
    if (const auto [other, fresh] = cases.emplace(slug_of(c.name), c.name); !fresh)
      throw InputError(experiment.name + ": cases '" + other->second + "' and '" + c.name +
                       "' would share the names of their figures, " + other->first +
                       "; expected names that differ in letters or digits");
  std::map<std::string, const ExperimentRun*> kept;
  for (const ExperimentRun& run : runs) {
    if (run.slug.size() > longest)
      throw InputError(experiment.name +
                       ": the names of a case and a method are too long for the name of a " +
                       "directory, runs/" + run.slug.substr(0, 40) + "...: expected " +
                       std::to_string(longest) + " letters at most, got " + std::to_string(run.slug.size()));
    const auto [other, fresh] = kept.emplace(run.slug, &run);
    if (!fresh)
      throw InputError(experiment.name + ": " + in_words(*other->second) + " and " + in_words(run) +
                       " would share the directory runs/" + run.slug + "; expected different names");
  }
  check_claims(experiment, runs);
  return runs;
}

}  // namespace pfaff
