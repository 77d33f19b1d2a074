// The command derive: equations of motion of a system as text and code, and how many operations they take.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <sstream>

#include <pfaff/bench/runner/settings.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/emit/emitter.hpp>
#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/derive/commands/commands.hpp>
#include <pfaff/derive/derivation/named_parameters.hpp>
#include <pfaff/runs/asked_for.hpp>

namespace pfaff {

namespace {

// The form of friction among the settings, which is taken out of them.
std::optional<FrictionForm> take_friction_form(Assignments& settings) {
  std::optional<FrictionForm> form;
  std::vector<std::string> names;
  for (const FrictionForm one : {FrictionForm::metriplectic, FrictionForm::stokes, FrictionForm::none})
    names.emplace_back(to_string(one));
  std::erase_if(settings, [&](const auto& setting) {
    if (setting.first != "friction-form") return false;
    for (const FrictionForm one : {FrictionForm::metriplectic, FrictionForm::stokes, FrictionForm::none})
      if (setting.second == to_string(one)) form = one;
    if (!form) throw InputError(unknown_name("friction-form", setting.second, names));
    return true;
  });
  return form;
}

// The degree of a generating function among the settings, which is taken out of them.
int take_order(Assignments& settings, const std::string& method) {
  int degree = 4;
  if (method != "generating-function") return degree;
  std::erase_if(settings, [&](const auto& setting) {
    if (setting.first != "order") return false;
    const std::optional<Real> order = Real::parse(setting.second);
    if (!order || !order->is_fraction() || order->denominator() != 1 || order->numerator() < 1 ||
        order->numerator() > largest_derived_degree)
      throw InputError("order: expected a whole number in 1 .. " + std::to_string(largest_derived_degree) +
                       ", got '" + setting.second + "'");
    degree = static_cast<int>(order->numerator());
    return true;
  });
  return degree;
}

// The order of elimination among the settings, which is taken out of them.
std::vector<std::string> take_elimination(Assignments& settings) {
  std::vector<std::string> names;
  std::erase_if(settings, [&](const auto& setting) {
    if (setting.first != "elimination") return false;
    std::istringstream list(setting.second);
    names.clear();
    for (std::string name; std::getline(list, name, ',');) names.push_back(name);
    return true;
  });
  return names;
}

// Prints the equations in a language.
int print_text(const Equations& equations, const std::string& language) {
  for (const Emitter& emitter : emitters())
    if (emitter.name == language) std::cout << emitter.write(equations);
  return 0;
}

int print_counts(const Equations& equations, double seconds, bool as_json) {
  const nlohmann::json counts{{"schema", 1},
                              {"system", equations.system},
                              {"method", equations.method},
                              {"equations", equations.coordinates.size()},
                              {"operations", operations(equations.tape)},
                              {"nodes", equations.tape.code.size()},
                              {"seconds", seconds}};
  if (as_json) {
    std::cout << json_text(counts);
    return 0;
  }
  std::string symbols;
  for (const Symbol& symbol : equations.parameters) symbols += (symbols.empty() ? "" : " ") + symbol.name;
  std::cout << table({{"system", "method", "equations", "operations", "nodes", "seconds"},
                      {equations.system, equations.method, std::to_string(equations.coordinates.size()),
                       std::to_string(operations(equations.tape)), std::to_string(equations.tape.code.size()),
                       scientific(seconds)}});
  std::cout << paragraph("symbols: " + (symbols.empty() ? "the coordinates alone" : symbols));
  return 0;
}

}  // namespace

int derive_command(const DerivationSettings& options, const Common& common) {
  Assignments settings = options.set;
  const DerivationOptions chosen{take_friction_form(settings), take_order(settings, options.method),
                                 take_elimination(settings)};
  const SystemPlugin& system = system_asked_for(options.system);
  const std::vector<std::string> known = derivation_forms();
  if (std::find(known.begin(), known.end(), options.emit) == known.end())
    throw InputError(unknown_name("--emit", options.emit, known));
  if (common.json && options.emit != "counts")
    throw InputError("--json is for --emit counts; expected " + options.emit + " without it");
  const SplitSettings split = split_settings(system, nullptr, nullptr, settings);
  if (!split.initial.empty() || !split.initial_velocities.empty())
    throw InputError("--set initial: equations do not depend on a state");
  double seconds = HUGE_VAL;  // of one derivation; finding out which parameters are symbols takes several
  const Equations equations = with_named_parameters(system, split.system, [&](const Model& model) {
    const auto begin = std::chrono::steady_clock::now();
    Equations made = derive(model, options.method, chosen);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    seconds = std::min(seconds, taken.count());
    return made;
  });
  if (options.emit != "counts") return print_text(equations, options.emit);
  return print_counts(equations, seconds, common.json);
}

}  // namespace pfaff
