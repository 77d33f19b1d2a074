#include <pfaff/bench/runner/settings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <pfaff/bench/measure/constraints.hpp>

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

namespace {
std::vector<std::string> split_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::stringstream stream(text + ',');  // so that nothing after the last comma is a part too
  for (std::string part; std::getline(stream, part, ',');) {
    const auto first = part.find_first_not_of(' '), last = part.find_last_not_of(' ');
    parts.push_back(first == std::string::npos ? "" : part.substr(first, last - first + 1));
  }
  return parts;
}

Real number(const std::string& text, const std::string& what) {
  const auto value = Real::parse(text);
  if (!value || !std::isfinite(value->value()))
    throw InputError(what + ": expected a finite decimal number or a/b, got '" + text + "'");
  return *value;
}

bool knows(const Plugin& plugin, const std::string& key) {
  return std::any_of(plugin.parameters().begin(), plugin.parameters().end(),
                     [&](const Parameter& p) { return p.name == key; });
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
  for (const auto& setting : set) {
    const std::string &key = setting.first, &value = setting.second;
    if (key == "initial") {
      split.initial = split_commas(value);
      continue;
    }
    if (const auto named = std::find_if(owners.begin(), owners.end(),
                                        [&](const Owner& o) { return key.starts_with(o.prefix); });
        named != owners.end()) {
      named->assignments->emplace_back(key.substr(named->prefix.size()), value);
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
      std::vector<std::string> names{"initial"};
      std::string of;
      for (const Owner& owner : owners) {
        of += (of.empty() ? "" : " or ") + owner.plugin->name();
        for (const Parameter& p : owner.plugin->parameters())
          names.push_back((dotted ? owner.prefix : "") + p.name);
      }
      throw InputError(unknown_name("parameter", key, names) + " (of " + of + ")");
    }
    knowing[0]->assignments->emplace_back(key, value);
  }
  return split;
}

std::shared_ptr<const Model> motion_for(const MethodInstance& method, std::shared_ptr<const Model> model) {
  if (!model->constrained() || method.refuses(*model).empty()) return model;
  return formulations().get("dirac", "formulation").apply(model, {});
}

std::vector<Real> state_numbers(const Model& model, const std::vector<std::string>& texts,
                                const std::string& what) {
  const auto dimension = static_cast<std::size_t>(model.dimension());
  if (texts.size() != dimension)
    throw InputError(what + " state of " + model.name() + ": expected " + std::to_string(dimension) +
                     " numbers, got " + std::to_string(texts.size()));
  std::vector<Real> numbers;
  for (std::size_t k = 0; k < dimension; ++k)
    numbers.push_back(number(texts[k], what + " " + model.coordinates()[k].name + " of " + model.name()));
  return numbers;
}

namespace {
// The state in `texts`, the model's own without.
std::vector<Real> initial_state(const Model& model, const std::vector<std::string>& texts) {
  const auto dimension = static_cast<std::size_t>(model.dimension());
  if (model.coordinates().size() != dimension)
    throw InputError("system " + model.name() + " names " + std::to_string(model.coordinates().size()) +
                     " coordinates; expected " + std::to_string(dimension));
  if (!texts.empty()) return state_numbers(model, texts, "initial");
  if (model.initial().size() != dimension)
    throw InputError("system " + model.name() + " has no initial state of its own; expected --set initial=");
  return model.initial();
}
}  // namespace

namespace {
// Which formulation a run of this system is looked at in; null where there is none.
const FormulationPlugin* formulation_of(const RunSettings& settings, const SystemPlugin& system) {
  if (!settings.formulation.empty()) {
    const FormulationPlugin& named = formulations().get(settings.formulation, "formulation");
    if (!system.constrained())
      throw InputError("--formulation: " + system.name() + " has no constraints; expected none");
    return &named;
  }
  return system.constrained() ? &formulations().get("dirac", "formulation") : nullptr;
}

// A state off the constraints is refused, or moved onto them, or taken as it is.
void check_consistency(const RunSettings& settings, ResolvedRun& run) {
  if (!run.model->constrained()) {
    if (settings.project_initial)
      throw InputError("--project-initial: system " + run.model->name() + " has no constraints");
    return;
  }
  if (settings.allow_inconsistent) return;
  std::vector<Quad> z;
  for (const Real& x : run.initial) z.push_back(x.quad());
  const ProjectionOntoConstraints projection = project_onto_constraints(*run.model, run.t0.quad(), z);
  std::array<char, 40> residual{}, change{};
  std::snprintf(residual.data(), residual.size(), "%.2g", projection.worst_residual);
  std::snprintf(change.data(), change.size(), "%.2g", projection.change);
  const std::string where = "initial state of " + run.model->name() + ": constraint " + projection.worst +
                            " is off by " + residual.data();
  if (projection.status != Status::converged)
    throw InputError(where + " and the state cannot be moved onto the constraints (" +
                     std::string(to_string(projection.status)) + ")");
  // Round-off of decimal inputs in double is no inconsistency.
  constexpr double round_off = 1e-13;
  if (settings.project_initial) {
    run.projected = projection.change;
    for (std::size_t k = 0; k < z.size(); ++k) run.initial[k] = Real(z[k]);
  } else if (projection.change > round_off) {
    throw InputError(where +
                     "; expected a state on the constraints, or --project-initial (which changes it by " +
                     change.data() + ", relatively), or --allow-inconsistent");
  }
}
}  // namespace

ResolvedState resolve_state(const RunSettings& settings) {
  const SystemPlugin& system = systems().get(settings.system, "system");
  const FormulationPlugin* formulation = formulation_of(settings, system);
  const SplitSettings split = split_settings(system, formulation, nullptr, settings.set);
  ResolvedState result;
  result.model = system.make(split.system);
  if (formulation != nullptr) result.model = formulation->apply(result.model, split.formulation);
  result.state = initial_state(*result.model, settings.initial.empty() ? split.initial : settings.initial);
  result.t = number(settings.t0, "time");
  return result;
}

ResolvedRun resolve(const RunSettings& settings) {
  ResolvedRun run;
  run.settings = settings;
  const SystemPlugin& system = systems().get(settings.system, "system");
  const MethodPlugin& method = integrators().get(settings.integrator, "integrator");
  const FormulationPlugin* formulation = formulation_of(settings, system);
  const SplitSettings split = split_settings(system, formulation, &method, settings.set);
  run.model = system.make(split.system);
  run.method = method.make(split.integrator);
  if (formulation != nullptr && !run.method->refuses(*run.model).empty()) {
    run.settings.formulation = formulation->name();
    run.model = formulation->apply(run.model, split.formulation);
  } else if (!settings.formulation.empty() || !split.formulation.empty()) {
    throw InputError(method.name() + " steps on the constraints of " + system.name() +
                     " themselves; expected no --formulation and no parameter of one");
  }
  if (const std::string reason = run.method->refuses(*run.model); !reason.empty()) throw InputError(reason);
  if (settings.precision == Precision::quad && run.method->descriptor().double_coefficients)
    throw InputError(method.name() + " has coefficients in double only; expected --precision double");

  run.initial = initial_state(*run.model, settings.initial.empty() ? split.initial : settings.initial);
  run.t0 = number(settings.t0, "initial time");
  run.time = number(settings.time, "--time");
  if (!(run.time > Real(0))) throw InputError("--time: expected a duration > 0, got '" + settings.time + "'");

  check_consistency(settings, run);
  // A state outside the domain of the formulas is refused here, not discovered as NaN later.
  if (run.model->facets().has(Facet::vector_field)) {
    const Problem<double> problem(run.model);
    std::vector<double> z, rate(run.initial.size());
    for (const Real& x : run.initial) z.push_back(x.value());
    problem.field(run.t0.value(), z, rate);
    for (const double x : rate)
      if (!std::isfinite(x))
        throw InputError("initial state of " + system.name() + ": the vector field is not finite there");
  }

  if (run.adaptive()) {
    if (!settings.step.empty()) throw InputError("--step and --tolerance exclude each other");
    run.tolerance = number(settings.tolerance, "--tolerance");
    if (!(run.tolerance > Real(0)) || run.tolerance > Real(1))
      throw InputError("--tolerance: expected a number in (0, 1], got '" + settings.tolerance + "'");
    if (!run.method->adaptive())
      throw InputError(method.name() + " takes fixed steps only; expected --step instead of --tolerance");
    if (settings.precision == Precision::quad)
      throw InputError("--tolerance: adaptive steps are available in double only");
    return run;
  }
  if (settings.step.empty())
    throw InputError("--step is missing (or --tolerance for methods that choose their steps)");
  run.step = number(settings.step, "--step");
  if (!(run.step > Real(0))) throw InputError("--step: expected a number > 0, got '" + settings.step + "'");
  if (run.step > run.time)
    throw InputError("--step: expected at most the duration " + settings.time + ", got '" + settings.step +
                     "'");
  const double ratio = (run.time / run.step).value();
  if (ratio > 1e15)
    throw InputError("--step: " + settings.step + " is too small for a duration of " + settings.time);
  // The horizon is a whole number of steps; a duration that is not is shortened to one.
  const double nearest = std::round(ratio);
  run.steps =
      static_cast<std::int64_t>(std::abs(ratio - nearest) < 1e-9 * nearest ? nearest : std::floor(ratio));
  run.every = settings.every > 0 ? settings.every : std::max<std::int64_t>(1, (run.steps + 999) / 1000);
  return run;
}

std::string config_text(const ResolvedRun& run) {
  std::ostringstream text;
  const auto quoted = [](const std::string& s) { return '"' + s + '"'; };
  text << "schema = 1\nsystem = " << quoted(run.model->name())
       << "\nintegrator = " << quoted(run.settings.integrator)
       << (run.settings.formulation.empty() ? "" : "\nformulation = " + quoted(run.settings.formulation))
       << "\nprecision = " << quoted(std::string(to_string(run.settings.precision)))
       << "\nt0 = " << quoted(to_string(run.t0)) << "\ntime = " << quoted(to_string(run.time)) << '\n';
  if (run.adaptive()) {
    text << "tolerance = " << quoted(to_string(run.tolerance)) << '\n';
  } else {
    text << "step = " << quoted(to_string(run.step)) << "\nevery = " << run.every << '\n';
  }
  if (run.settings.allow_inconsistent) text << "allow_inconsistent = \"yes\"\n";
  text << "initial = [";
  for (std::size_t k = 0; k < run.initial.size(); ++k)
    text << (k == 0 ? "" : ", ") << quoted(to_string(run.initial[k]));
  text << "]\n\n[set]\n";
  for (const auto& [key, value] : run.model->parameters())
    text << "\"system." << key << "\" = " << quoted(value) << '\n';
  for (const auto& [key, value] : run.model->source().formulation_parameters)
    text << "\"formulation." << key << "\" = " << quoted(value) << '\n';
  for (const auto& [key, value] : run.method->parameters())
    text << "\"integrator." << key << "\" = " << quoted(value) << '\n';
  return text.str();
}

}  // namespace pfaff
