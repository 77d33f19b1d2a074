#include "grammar.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff::fuzz {

std::string quoted(const std::string& text) { return '"' + text + '"'; }

namespace {
// Systems and methods whose models are made quickly.
const std::vector<std::string>& small_systems() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> small;
    for (const SystemPlugin* system : systems().all())
      for (const char* name :
           {"damped-oscillator", "damped-pendulum", "harmonic-oscillator", "kepler", "henon-heiles",
            "lotka-volterra", "free-rigid-body", "spherical-pendulum", "sphere-particle"})
        if (system->name() == name) small.push_back(name);
    return small;
  }();
  return names;
}
const std::vector<std::string>& some_methods() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> some;
    for (const MethodPlugin* method : integrators().all())
      for (const char* name :
           {"rk4", "explicit-euler", "verlet", "gauss", "composition", "splitting", "odeint-dopri5",
            "generating-function", "leap-frog", "rattle", "conformal-splitting"})
        if (method->name() == name) some.push_back(name);
    return some;
  }();
  return names;
}

std::size_t dimension_of(const std::string& system) {
  const SystemPlugin* plugin = systems().find(system);
  return plugin == nullptr ? 2 : plugin->descriptor().coordinates.size();
}

std::string list_of_numbers(Choices& choices, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    const std::string number = random_number(choices);
    const bool bare = number.find('/') == std::string::npos && !choices.once_in(2);
    text += (k == 0 ? "" : ", ") + (bare ? number : quoted(number));
  }
  return '[' + text + ']';
}

// Numbers that a step, or a duration, may well be.
std::string positive_number(Choices& choices) {
  return choices.once_in(40) ? random_number(choices)
                             : choices.one_of({"0.1", "0.25", "1/8", "0.5", "1e-2", "0.125", "5e-1"});
}
std::string duration(Choices& choices) {
  return choices.once_in(40) ? random_number(choices)
                             : choices.one_of({"1", "0.5", "2", "3/2", "1.0", "1e0", "-1", "-3/2"});
}
std::string precision(Choices& choices) { return choices.one_of({"double", "double", "double", "quad"}); }

std::string random_state(Choices& choices) {
  const std::size_t dimension = choices.once_in(20) ? choices.below(9) : 2 * (1 + choices.below(3));
  std::string text = "{";
  if (choices.once_in(3)) text += "\"schema\": 1, ";
  if (choices.once_in(2)) text += "\"t\": " + random_number(choices) + ", ";
  if (choices.once_in(2)) {
    text += "\"z\": " + list_of_numbers(choices, dimension);
  } else {
    text += "\"q\": " + list_of_numbers(choices, dimension / 2) +
            ", \"p\": " + list_of_numbers(choices, dimension / 2);
  }
  return text + "}\n";
}

std::string random_configuration(Choices& choices) {
  const std::string system = choices.one_of(small_systems()), method = choices.one_of(some_methods());
  std::ostringstream text;
  text << "schema = 1\nsystem = " << quoted(system) << "\nintegrator = " << quoted(method) << '\n';
  if (choices.once_in(12))
    text << "formulation = " << quoted(choices.one_of({"dirac", "lagrange", "none"})) << '\n';
  if (choices.once_in(2)) text << "precision = " << quoted(precision(choices)) << '\n';
  if (choices.once_in(3)) text << "t0 = " << random_number(choices) << '\n';
  text << "time = " << quoted(duration(choices)) << '\n';
  if (method == "odeint-dopri5" && choices.once_in(2)) {
    text << "tolerance = " << choices.one_of({"1e-6", "1.0e-9", "\"1/1000\"", "0.5"}) << '\n';
    if (choices.once_in(3))
      text << "absolute = " << choices.one_of({"1e-9", "[1e-9, 0]", "[\"1/3\"]", "[]", "-1"}) << '\n';
  } else {
    text << "step = " << quoted(positive_number(choices)) << '\n';
    if (choices.once_in(4)) text << "every = " << 1 + choices.below(3) << '\n';
  }
  if (choices.once_in(8))
    text << "reference = " << quoted(choices.one_of({"none", "exact", "every", "solution,every"})) << '\n';
  if (choices.once_in(8)) text << "compile = \"no\"\n";  // a compiler for each input would take minutes
  if (choices.once_in(8)) text << "allow_inconsistent = " << quoted(choices.one_of({"yes", "no"})) << '\n';
  if (choices.once_in(2)) text << "initial = " << list_of_numbers(choices, dimension_of(system)) << '\n';
  text << "\n[set]\n";
  for (const Setting& s : random_settings(choices, "system", system, "system."))
    text << quoted(s.key) << " = " << quoted(s.value) << '\n';
  for (const Setting& s : random_settings(choices, "integrator", method, "integrator."))
    text << quoted(s.key) << " = " << quoted(s.value) << '\n';
  return text.str();
}

std::string inline_table(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& s : settings)
    text += (text.empty() ? " " : ", ") + quoted(s.key) + " = " + quoted(s.value);
  return '{' + text + " }";
}

std::string random_experiment(Choices& choices) {
  std::ostringstream text;
  text << "schema = 1\ntitle = " << quoted(choices.one_of({"A test", "\\u00e9tude", "a \\t b", ""})) << '\n';
  if (choices.once_in(3)) text << "description = \"\"\"\nLines.\n\"\"\"\n";
  if (choices.once_in(2)) text << "reference = [\"su-qin\"]\n";
  if (choices.once_in(4)) text << "notes = [\"one\", \"two\"]\n";
  if (choices.once_in(8))
    text << "methods = "
         << choices.one_of({R"("all")", R"({ keeps = "symplectic" })",
                            R"({ needs = "separable", order = ">= 4" })",
                            R"({ order = [">= 2", "< 5"], set = { stages = [1, 2] } })"})
         << '\n';
  if (choices.once_in(8)) text << "[quick]\ntitle = \"A quick test\"\n";
  std::vector<std::string> labels;
  for (std::size_t k = 0, count = 1 + choices.below(2); k < count; ++k) {
    const std::string method = choices.one_of(some_methods());
    labels.push_back(method + " " + std::to_string(k) + (choices.once_in(2) ? " with a long label" : ""));
    text << "\n[[method]]\nlabel = " << quoted(labels.back()) << "\nintegrator = " << quoted(method) << '\n';
    if (choices.once_in(2))
      text << "set = " << inline_table(random_settings(choices, "integrator", method, "")) << '\n';
    if (method == "odeint-dopri5" && choices.once_in(2)) {
      text << "tolerance = [1e-6, \"1e-8\"]\n";
      if (choices.once_in(2)) text << "absolute = " << choices.one_of({"1e-9", "[1e-9, 0]"}) << '\n';
    }
  }
  std::vector<std::string> names;
  for (std::size_t k = 0, count = 1 + choices.below(2); k < count; ++k) {
    const std::string system = choices.one_of(small_systems());
    names.push_back("case " + std::to_string(k) + (choices.once_in(2) ? " with a long name" : ""));
    text << "\n[[case]]\nname = " << quoted(names.back()) << "\nsystem = " << quoted(system)
         << "\ntime = " << quoted(duration(choices)) << "\nsteps = ";
    if (choices.once_in(6)) {
      text << "\"auto\"\n";
      if (choices.once_in(2)) text << "evaluations = " << positive_number(choices) << '\n';
    } else {
      text << '[' << quoted(positive_number(choices)) << "]\n";
    }
    if (choices.once_in(2))
      text << "set = " << inline_table(random_settings(choices, "system", system, "")) << '\n';
    if (choices.once_in(3)) text << "initial = " << list_of_numbers(choices, dimension_of(system)) << '\n';
    if (choices.once_in(4)) text << "precision = " << quoted(precision(choices)) << '\n';
    if (choices.once_in(4)) text << "conserved = \"energy\"\n";
    if (choices.once_in(6)) text << "motion = " << choices.one_of({R"(["q", "p"])", R"(["x"])"}) << '\n';
    if (choices.once_in(4)) text << "methods = [" << quoted(choices.one_of(labels)) << "]\n";
    if (choices.once_in(6)) text << "seeds = " << choices.below(3) << '\n';
    if (choices.once_in(6))
      text << "reference = " << quoted(choices.one_of({"none", "solution", "every", "solution,every"}))
           << '\n';
    if (choices.once_in(6)) text << "structure = " << quoted(choices.one_of({"none", "residual"})) << '\n';
    if (choices.once_in(4)) text << "[case.quick]\ntime = " << quoted(duration(choices)) << '\n';
  }
  if (choices.once_in(3)) {
    text << "\n[[finding]]\ncase = " << quoted(choices.one_of(names))
         << "\nmethod = " << quoted(choices.one_of(labels))
         << "\nmeasure = " << quoted(choices.one_of({"error_max", "error_final", "energy:max", "energy:rms"}))
         << "\nrelation = " << quoted(choices.one_of({"exceeds", "stays-below"})) << '\n';
    if (choices.once_in(2)) {
      text << "bound = " << positive_number(choices) << '\n';
    } else {
      text << "than = " << quoted(choices.one_of(labels)) << '\n';
    }
    if (choices.once_in(2)) text << "factor = 2.5\n";
  }
  return text.str();
}

bool number_at(const std::string& text, std::size_t k) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const bool before =
      k > 0 && (digit(text[k - 1]) || std::isalpha(static_cast<unsigned char>(text[k - 1])) != 0);
  return digit(text[k]) && !before;
}
}  // namespace

std::string random_number(Choices& choices) {
  if (choices.once_in(12))
    return choices.one_of({"0", "-0.0", "1e300", "-1e300", "1e-320", "4.9e-324", "1e4000", "1e-4940",
                           "9223372036854775807", "-9223372036854775808", "9223372036854775808",
                           "0.30000000000000000000000000000000001", "123456789012345678901234567890", "1e18",
                           "1e-18", "1e19", "999999999999999999.9"});
  const std::string whole = std::to_string(choices.below(4)), fraction = std::to_string(choices.below(1000));
  return (choices.once_in(4) ? "-" : "") + whole + '.' + fraction + (choices.once_in(10) ? "e-1" : "");
}

std::vector<Setting> random_settings(Choices& choices, const std::string& kind, const std::string& name,
                                     const std::string& prefix) {
  const Plugin* plugin = kind == "system" ? static_cast<const Plugin*>(systems().find(name))
                                          : static_cast<const Plugin*>(integrators().find(name));
  std::vector<Setting> settings;
  if (plugin == nullptr) return settings;
  for (const Parameter& p : plugin->parameters()) {
    if (!choices.once_in(3)) continue;
    std::string value;
    if (p.kind == Parameter::Kind::choice) {
      value = choices.one_of(p.choices);
    } else if (p.kind == Parameter::Kind::plugin) {
      value = choices.one_of({"verlet", "gauss", "gauss(stages=1)", "verlet(compensated=no)", "splitting"});
    } else if (p.kind == Parameter::Kind::integer) {
      value = std::to_string(static_cast<long>(p.minimum) + static_cast<long>(choices.below(3)));
    } else if (p.kind == Parameter::Kind::real) {
      const double low = std::max(p.minimum, -10.0), high = std::min(p.maximum, 10.0);
      value = std::to_string(low + (high - low) * static_cast<double>(choices.below(65)) / 64);
    } else {
      continue;
    }
    settings.push_back({prefix + p.name, choices.once_in(60) ? random_number(choices) : value});
  }
  return settings;
}

std::string made_odd(std::string text, Choices& choices) {
  if (text.empty()) return text;
  const auto replace_number = [&] {
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < text.size(); ++k)
      if (number_at(text, k)) places.push_back(k);
    if (places.empty()) return;
    const std::size_t begin = choices.one_of(places);
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e", begin), text.size());
    text.replace(begin, end - begin,
                 choices.once_in(2)
                     ? random_number(choices)
                     : choices.one_of({"1e99999", "1_000", "true", "[]", "\"\"", "1.5e", "07", "1/0",
                                       "\"1/3\"", "{}", "1979-05-27", "0.1.2", "inf", "nan", "0x1F"}));
  };
  const auto replace_text = [&] {
    const std::size_t begin = text.find('"', choices.below(text.size()));
    const std::size_t end = begin == std::string::npos ? begin : text.find('"', begin + 1);
    if (end == std::string::npos || text.find('\n', begin) < end) return;
    text.replace(
        begin + 1, end - begin - 1,
        choices.one_of({"", "a", "\\u0000", "\\u001b[31m", "composition(base=composition(base=verlet))",
                        "verlet(", "verlet(a=1,a=2)", "verlet(,)", "..", "initial", "1,2", "/", "\xC3\xA9",
                        "gauss(stages=2, compensated=no)", "\xFF", "system.system.nu",
                        "a text of more than sixteen characters", "a-name-of-more-than-sixteen-characters"}));
  };
  const auto change_line = [&] {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.empty()) return;
    const std::size_t which = choices.below(lines.size());
    const std::size_t how = choices.below(4);
    if (how == 0) lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(which));
    if (how == 1) lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(which), lines[which]);
    if (how == 2) std::swap(lines[which], lines[choices.below(lines.size())]);
    if (how == 3) lines[which].resize(choices.below(lines[which].size() + 1));
    text.clear();
    for (const std::string& line : lines) text += line + '\n';
  };
  switch (choices.below(4)) {
    case 0:
      change_line();
      break;
    case 1:
      replace_text();
      break;
    default:
      replace_number();
  }
  return text;
}

Input random_input(Language language, Choices& choices) {
  Input input;
  switch (language) {
    case Language::state:
      input = {"state.json", random_state(choices)};
      break;
    case Language::configuration:
      input = {"config.toml", random_configuration(choices)};
      break;
    case Language::experiment:
      input = {"experiment.toml", random_experiment(choices)};
      break;
    case Language::model:
      if (choices.once_in(2)) {
        input = {"model.toml", random_model_toml(choices)};
      } else {
        input = {"model.json", random_model_json(choices)};
      }
      break;
    case Language::text:
      input = {"text.toml", random_text_model(choices)};
      break;
    case Language::bracket:
      input = {"bracket.toml", random_text_bracket(choices)};
      break;
    case Language::table:
      input = {"table.toml", random_table(choices)};
      break;
  }
  while (choices.once_in(4)) input.text = made_odd(input.text, choices);
  return input;
}

}  // namespace pfaff::fuzz
