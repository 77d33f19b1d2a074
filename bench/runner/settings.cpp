#include <pfaff/bench/runner/settings.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

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

SplitSettings split_settings(const SystemPlugin& system, const MethodPlugin* method, const Assignments& set) {
  SplitSettings split;
  for (const auto& [key, value] : set) {
    if (key == "initial") {
      split.initial = split_commas(value);
    } else if (key.starts_with("system.")) {
      split.system.emplace_back(key.substr(7), value);
    } else if (method != nullptr && key.starts_with("integrator.")) {
      split.integrator.emplace_back(key.substr(11), value);
    } else {
      const bool of_system = knows(system, key), of_method = method != nullptr && knows(*method, key);
      if (of_system && of_method)
        throw InputError("parameter '" + key + "' belongs to both " + system.name() + " and " +
                         method->name() + "; expected system." + key + " or integrator." + key);
      if (!of_system && !of_method) {
        std::vector<std::string> names{"initial"};
        for (const Parameter& p : system.parameters()) names.push_back(p.name);
        if (method != nullptr)
          for (const Parameter& p : method->parameters()) names.push_back(p.name);
        if (key.find('.') != std::string::npos) {
          for (std::size_t k = 0, bare = names.size(); k < bare; ++k)
            names[k] = (k == 0 ? "" : knows(system, names[k]) ? "system." : "integrator.") + names[k];
        }
        throw InputError(unknown_name("parameter", key, names) + " (of " + system.name() +
                         (method != nullptr ? " or " + method->name() : "") + ")");
      }
      (of_system ? split.system : split.integrator).emplace_back(key, value);
    }
  }
  return split;
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

ResolvedState resolve_state(const RunSettings& settings) {
  const SystemPlugin& system = systems().get(settings.system, "system");
  const SplitSettings split = split_settings(system, nullptr, settings.set);
  ResolvedState result;
  result.model = system.make(split.system);
  result.state = initial_state(*result.model, settings.initial.empty() ? split.initial : settings.initial);
  result.t = number(settings.t0, "time");
  return result;
}

ResolvedRun resolve(const RunSettings& settings) {
  ResolvedRun run;
  run.settings = settings;
  const SystemPlugin& system = systems().get(settings.system, "system");
  const MethodPlugin& method = integrators().get(settings.integrator, "integrator");
  const SplitSettings split = split_settings(system, &method, settings.set);
  run.model = system.make(split.system);
  run.method = method.make(split.integrator);
  if (const std::string reason = run.method->refuses(*run.model); !reason.empty()) throw InputError(reason);
  if (settings.precision == Precision::quad && run.method->descriptor().double_coefficients)
    throw InputError(method.name() + " has coefficients in double only; expected --precision double");

  run.initial = initial_state(*run.model, settings.initial.empty() ? split.initial : settings.initial);
  run.t0 = number(settings.t0, "initial time");
  run.time = number(settings.time, "--time");
  if (!(run.time > Real(0))) throw InputError("--time: expected a duration > 0, got '" + settings.time + "'");

  // A state outside the domain of the formulas is refused here, not discovered as NaN later.
  const Problem<double> problem(run.model);
  std::vector<double> z, rate(run.initial.size());
  for (const Real& x : run.initial) z.push_back(x.value());
  problem.field(run.t0.value(), z, rate);
  for (const double x : rate)
    if (!std::isfinite(x))
      throw InputError("initial state of " + system.name() + ": the vector field is not finite there");

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
       << "\nprecision = " << quoted(std::string(to_string(run.settings.precision)))
       << "\nt0 = " << quoted(to_string(run.t0)) << "\ntime = " << quoted(to_string(run.time)) << '\n';
  if (run.adaptive()) {
    text << "tolerance = " << quoted(to_string(run.tolerance)) << '\n';
  } else {
    text << "step = " << quoted(to_string(run.step)) << "\nevery = " << run.every << '\n';
  }
  text << "initial = [";
  for (std::size_t k = 0; k < run.initial.size(); ++k)
    text << (k == 0 ? "" : ", ") << quoted(to_string(run.initial[k]));
  text << "]\n\n[set]\n";
  for (const auto& [key, value] : run.model->parameters())
    text << "\"system." << key << "\" = " << quoted(value) << '\n';
  for (const auto& [key, value] : run.method->parameters())
    text << "\"integrator." << key << "\" = " << quoted(value) << '\n';
  return text.str();
}

}  // namespace pfaff
