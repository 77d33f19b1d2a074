#include <pfaff/bench/runner/settings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <pfaff/bench/runner/expressions.hpp>
#include <pfaff/bench/runner/initial_state.hpp>
#include <pfaff/bench/runner/stated_identities.hpp>
#include <pfaff/bench/runner/steps.hpp>
#include <pfaff/core/native/compiled_model.hpp>
#include <pfaff/core/numbers/formatted.hpp>
#include <pfaff/core/process/checksum.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/state_checks.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff {

Precision parse_precision(const std::string& text) {
  if (text == "double") return Precision::double_precision;
  if (text == "quad") return Precision::quad;
  throw InputError(unknown_name("precision", text, {"double", "quad"}));
}
std::int64_t parse_every(const std::string& text, const std::string& where) {
  const auto number = Real::parse(text);
  if (!number || !number->is_fraction() || number->denominator() != 1 || number->numerator() < 1)
    throw InputError(where + ": expected a whole number of steps > 0, got '" + text + "'");
  return number->numerator();
}
std::string_view to_string(Precision precision) { return precision == Precision::quad ? "quad" : "double"; }

std::string_view to_string(ErrorsAgainst against) {
  constexpr std::array<std::string_view, 3> names{"none", "exact", "solution"};
  return names[static_cast<std::size_t>(against)];
}

namespace {
constexpr const char* every_row = "every";
}

std::string to_string(const AskedReference& asked) {
  return std::string(to_string(asked.against)) + (asked.every_row ? std::string(",") + every_row : "");
}

AskedReference parse_reference(const std::string& text, const std::string& where,
                               const std::vector<ErrorsAgainst>& known) {
  AskedReference asked{known.front()};
  std::vector<std::string> names;
  for (const ErrorsAgainst against : known) names.emplace_back(to_string(against));
  names.emplace_back(every_row);
  bool named = false;
  for (const std::string& part : split_commas(text)) {
    const auto name = std::find(names.begin(), names.end(), part);
    if (name == names.end()) throw InputError(where + ": " + unknown_name("reference", part, names));
    const bool every = part == every_row;
    if (every ? asked.every_row : named)
      throw InputError(where + ": expected one reference, and '" + every_row + "' once, got '" + text + "'");
    if (every) {
      asked.every_row = true;
    } else {
      named = true;
      asked.against = known[static_cast<std::size_t>(name - names.begin())];
    }
  }
  if (asked.every_row && asked.against == ErrorsAgainst::none)
    throw InputError(where + ": 'none' measures no errors; expected no '" + every_row + "' beside it");
  return asked;
}

std::string called(std::string name, const Assignments& parameters) {
  for (const auto& [key, value] : parameters) name += " " + key + "=" + value;
  return name;
}

std::vector<std::string> split_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text + ',');  // getline drops an empty last part unless a comma ends it
  for (std::string part; std::getline(stream, part, ',');) {
    const auto first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
  }
  return parts;
}

namespace {
bool knows(const Plugin& plugin, const std::string& key) {
  return std::any_of(plugin.parameters().begin(), plugin.parameters().end(),
                     [&](const Parameter& p) { return p.takes(key); });
}
}  // namespace

SplitSettings split_settings(const SystemPlugin& system, const FormulationPlugin* formulation,
                             const MethodPlugin* method, const Assignments& set) {
  SplitSettings split;
  struct Owner {
    std::string prefix;
    const Plugin* plugin;
    Assignments* assignments;
  };
  std::vector<Owner> owners{{"system.", &system, &split.system}};
  if (formulation != nullptr) owners.push_back({"formulation.", formulation, &split.formulation});
  if (method != nullptr) owners.push_back({"integrator.", method, &split.integrator});
  const auto give = [](const Owner& owner, const std::string& key, std::string value) {
    const auto& known = owner.plugin->parameters();
    const auto parameter =
        std::find_if(known.begin(), known.end(), [&](const Parameter& p) { return p.name == key; });
    if (parameter != known.end() &&
        (parameter->kind == Parameter::Kind::real || parameter->kind == Parameter::Kind::integer))
      value = evaluated(value, "parameter '" + key + "' of " + owner.plugin->name());
    if (is_set(*owner.assignments, key))
      throw InputError("parameter '" + key + "' of " + owner.plugin->name() +
                       " is set twice; expected one value");
    owner.assignments->emplace_back(key, std::move(value));
  };
  for (const auto& setting : set) {
    const std::string &key = setting.first, &value = setting.second;
    if (key == "initial" || key == "initial_velocities") {
      std::vector<std::string>& numbers = key == "initial" ? split.initial : split.initial_velocities;
      if (!numbers.empty()) throw InputError("'" + key + "' is set twice; expected one state");
      numbers = split_commas(value);
      continue;
    }
    if (const auto named = std::find_if(owners.begin(), owners.end(),
                                        [&](const Owner& o) { return key.starts_with(o.prefix); });
        named != owners.end()) {
      give(*named, key.substr(named->prefix.size()), value);
      continue;
    }
    std::vector<const Owner*> knowing;
    for (const Owner& owner : owners)
      if (knows(*owner.plugin, key)) knowing.push_back(&owner);
    if (knowing.size() > 1)
      throw InputError("parameter '" + key + "' belongs to both " + knowing[0]->plugin->name() + " and " +
                       knowing[1]->plugin->name() + "; expected " + knowing[0]->prefix + key + " or " +
                       knowing[1]->prefix + key);
    if (knowing.empty()) {
      const bool dotted = key.find('.') != std::string::npos;
      std::vector<std::string> names{"initial", "initial_velocities"};
      std::string of;
      for (const Owner& owner : owners) {
        of += (of.empty() ? "" : " or ") + owner.plugin->name();
        for (const Parameter& p : owner.plugin->parameters())
          names.push_back((dotted ? owner.prefix : "") + p.name);
      }
      throw InputError(unknown_name("parameter", key, names) + " (of " + of + ")");
    }
    give(*knowing[0], key, value);
  }
  return split;
}

namespace {
// Refuses a state at which the velocity constraints of a system define no motion. `whole` is the system
// before a formulation was applied, which may have solved the constraints.
void check_independence(const Model& whole, const ResolvedRun& run) {
  if (!whole.nonholonomic()) return;
  std::vector<Quad> z;
  for (const Real& x : run.initial) z.push_back(x.quad());
  if (const std::string reason = dependent_velocity_constraints(whole, run.t0.quad(), z); !reason.empty())
    throw InputError("initial state of " + whole.name() + ": " + reason +
                     "; expected a state where the constraints are independent");
}

// Decides about an initial state that is off the constraints, according to the settings: it is moved onto
// them, taken as it is, or refused (InputError).
void check_consistency(const RunSettings& settings, ResolvedRun& run) {
  if (!run.model->restricted()) {
    if (settings.project_initial || settings.allow_inconsistent)
      throw InputError(
          std::string(settings.project_initial ? "--project-initial: " : "--allow-inconsistent: ") +
          (run.model->source().formulation.empty()
               ? "system " + run.model->name() + " has no constraints"
               : "states of formulation " + run.model->source().formulation + " are not constrained"));
    return;
  }
  if (settings.allow_inconsistent) return;
  std::vector<Quad> z;
  for (const Real& x : run.initial) z.push_back(x.quad());
  const Consistency found = consistency_of(*run.model, run.t0.quad(), z);
  if (settings.project_initial) {
    run.projected = found.projection.change;
    for (std::size_t k = 0; k < z.size(); ++k) run.initial[k] = Real(z[k]);
  } else if (!found.on_constraints()) {
    throw InputError(found.where +
                     "; expected a state on the constraints, or --project-initial (which changes it by " +
                     formatted("%.2g", found.projection.change) + ", relatively), or --allow-inconsistent");
  }
}

// The state that is asked for, of each of the two places for it.
AskedState asked_state(const RunSettings& settings, const SplitSettings& split) {
  const auto either = [](const std::vector<std::string>& a, const std::vector<std::string>& b,
                         const std::string& key) {
    if (!a.empty() && !b.empty())
      throw InputError("'" + key + "' is set twice, by itself and among the parameters; expected one state");
    return a.empty() ? b : a;
  };
  return {either(settings.initial, split.initial, "initial"),
          either(settings.initial_velocities, split.initial_velocities, "initial_velocities")};
}
// Fills in run.origins. Plug-ins are null for what was made in a program, of which only what ships is known
// by its name. `read` are the files as they were before the model was made of them.
void note_origins(ResolvedRun& run, const SystemPlugin* system, const MethodPlugin* method,
                  const Assignments& read) {
  run.origins.libraries = libraries();
  // A text model is made when its file is read and belongs to no shared object.
  if (const auto* text = dynamic_cast<const TextSystem*>(system)) {
    for (const auto& [path, contents] : text->files()) add_file(run.origins, path, sha1_of(contents));
    for (const auto& [plugin, values] : text->rests_on()) add_origins(*plugin, values, run.origins);
  } else if (system != nullptr) {
    add_origins(*system, run.model->parameters(), run.origins);
  } else {
    add_library_of(systems().find(run.model->name()), run.origins);
  }
  for (const auto& [path, hash] : read)
    if (std::find(run.origins.files.begin(), run.origins.files.end(), std::pair(path, hash)) ==
        run.origins.files.end())
      throw InputError(path + ": changed while it was read; expected a file that stays as it is");
  if (method != nullptr)
    add_origins(*method, run.method->parameters(), run.origins);
  else
    add_library_of(integrators().find(run.method->descriptor().name), run.origins);
  if (!run.settings.formulation.empty())
    add_origins(formulations().get(run.settings.formulation, "formulation"),
                run.model->source().formulation_parameters, run.origins);
  if (run.settings.compile && run.settings.precision == Precision::double_precision)
    add_compiler(run.origins);
}

template <class T>
void check_domain_of(const ResolvedRun& run) {
  std::vector<T> z;
  for (const Real& x : run.initial) z.push_back(T(x));
  check_domain(run.model, T(run.t0), z);
}

// What the names and parameters of a run stand for.
struct RunObjects {
  std::shared_ptr<const Model> whole;  // the system, before a formulation
  std::shared_ptr<const MethodInstance> method;
  const FormulationPlugin* formulation;  // the one that makes a motion where the method needs that; or null
  Assignments of_formulation;
  AskedState state;
};

// The model that the method steps on, with all checks of whether the two fit.
void choose_model(ResolvedRun& run, const RunObjects& objects) {
  const RunSettings& settings = run.settings;
  run.model = objects.whole;
  run.method = objects.method;
  if (objects.formulation != nullptr && !run.method->refuses(*run.model).empty()) {
    run.model = objects.formulation->apply(run.model, objects.of_formulation);
    run.settings.formulation = objects.formulation->name();
  } else if (!settings.formulation.empty() || !objects.of_formulation.empty()) {
    throw InputError(run.method->called() + " steps on the constraints of " + run.model->name() +
                     " themselves; expected no --formulation and no parameter of one");
  }
  if (const std::string reason = run.method->refuses(*run.model); !reason.empty())
    throw InputError(reason + what_to_do(*run.method, *run.model));
  if (settings.precision == Precision::quad && run.method->descriptor().double_coefficients)
    throw InputError(run.method->called() + " has coefficients in double only; expected --precision double");
  if (settings.compile && settings.precision == Precision::double_precision) run.model = compiled(run.model);
}

// Times, the state, the step: all that is asked of objects that fit.
void check_objects(ResolvedRun& run, const RunObjects& objects) {
  RunSettings& settings = run.settings;
  const std::string asked_time = settings.time;
  for (const auto& [number, what] : {std::pair(&settings.t0, "initial time"),
                                     {&settings.time, "--time"},
                                     {&settings.step, "--step"},
                                     {&settings.tolerance, "--tolerance"}})
    *number = evaluated(*number, what, run.model->parameters());
  run.t0 = finite_number(settings.t0, "initial time");
  run.time = finite_number(settings.time, "--time");
  if (run.time == Real(0))
    throw InputError("--time: expected a duration other than 0, got '" + asked_time + "'");

  run.initial = initial_state(*run.model, objects.state, run.t0);
  run.given_initial = run.initial;
  check_independence(*objects.whole, run);
  check_consistency(settings, run);
  settings.precision == Precision::quad ? check_domain_of<Quad>(run) : check_domain_of<double>(run);
  check_stated_identities(objects.whole, run.t0, run.initial);
  run.not_conserved = not_conserved(objects.whole, run.t0, run.initial);
  resolve_steps(run);
}
}  // namespace

ResolvedState resolve_state(const RunSettings& settings) {
  const SystemPlugin& system = system_asked_for(settings.system);
  const FormulationPlugin* formulation = formulation_for(system, settings.formulation);
  const SplitSettings split = split_settings(system, formulation, nullptr, settings.set);
  ResolvedState result;
  result.model = system.make(split.system);
  if (formulation != nullptr) result.model = formulation->apply(result.model, split.formulation);
  if (settings.compile) result.model = compiled(result.model);
  const Assignments& parameters = result.model->parameters();
  result.t = finite_number(evaluated(settings.t0, "time", parameters), "time");
  result.state = initial_state(*result.model, asked_state(settings, split), result.t);
  return result;
}

ResolvedRun resolve(const RunSettings& settings) {
  ResolvedRun run;
  run.settings = settings;
  RunObjects objects{settings.model, settings.method, nullptr, {}, {}};
  const SystemPlugin* const system = settings.model ? nullptr : &system_asked_for(settings.system);
  const MethodPlugin* const method = settings.method ? nullptr : &integrator_asked_for(settings.integrator);
  const auto* table = dynamic_cast<const MethodTable*>(method);
  run.settings.integrator = method == nullptr  ? settings.method->called()
                            : table != nullptr ? table->path()
                                               : method->name();
  SplitSettings split;
  Assignments read;
  if (system != nullptr) {
    const auto* text = dynamic_cast<const TextSystem*>(system);
    run.settings.system = text != nullptr ? text->files().front().first : system->name();
    objects.formulation = formulation_for(*system, settings.formulation);
    split = split_settings(*system, objects.formulation, method, settings.set);
    split.system = with_absolute_paths(system->parameters(), std::move(split.system));
    read = files_of(system->parameters(), split.system);
    objects.whole = system->make(split.system);
  } else {
    if (!settings.set.empty())
      throw InputError("'" + settings.set.front().first +
                       "': expected the parameters of objects to be set where these are made");
    run.settings.system = settings.model->name();
    AskedFormulation asked = formulation_asked_for(*settings.model, settings.formulation);
    objects.formulation = asked.plugin;
    split.formulation = std::move(asked.parameters);
  }
  if (method != nullptr)
    objects.method = method->make(with_absolute_paths(method->parameters(), std::move(split.integrator)));
  if (objects.formulation != nullptr)
    objects.of_formulation =
        with_absolute_paths(objects.formulation->parameters(), std::move(split.formulation));
  objects.state = asked_state(settings, split);
  choose_model(run, objects);
  note_origins(run, system, method, read);
  check_objects(run, objects);
  return run;
}

}  // namespace pfaff
