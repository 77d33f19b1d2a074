#include <pfaff/verify/near_parameters.hpp>

#include <algorithm>
#include <random>

namespace pfaff {

namespace {
// A value of a number in its range, or the given one of what is no real number.
std::string value_near(const Parameter& parameter, const std::string& given, std::mt19937_64& random) {
  const auto number = Real::parse(given);
  if (parameter.kind != Parameter::Kind::real || !number) return given;
  const std::uint64_t eighths =
      random() % 8;  // of the range of what is drawn, but for the four that are the default
  const double share = static_cast<double>(eighths < 4 ? eighths : eighths + 1) / 8, value = number->value();
  const double wanted =
      value == 0 ? std::min(1.0, parameter.maximum) * (share + 0.25) : value * (0.625 + 0.75 * share);
  return to_string(Quad(std::clamp(wanted, parameter.minimum, parameter.maximum)), 6);
}

// `parameters_with` gives all parameters of the plug-in as it is made with some; InputError where it refuses
// them.
template <class P, class Made>
std::vector<Assignments> drawn_near(const P& plugin, int count, const Made& parameters_with) {
  std::vector<Assignments> list;
  const Assignments defaults = parameters_with({});
  std::mt19937_64 random(20050);
  for (int k = 0; k < count; ++k) {
    Assignments drawn;
    for (const Parameter& parameter : plugin.parameters())
      for (const auto& [name, value] : defaults)
        if (name == parameter.name)
          if (std::string near = value_near(parameter, value, random); near != value)
            drawn.emplace_back(name, std::move(near));
    try {
      if (!drawn.empty() && !parameters_with(drawn).empty()) list.push_back(std::move(drawn));
    } catch (const InputError&) {
      continue;  // what the author refuses is claimed by nobody
    }
  }
  return list;
}
}  // namespace

std::vector<Assignments> parameters_near_defaults(const MethodPlugin& method, int count) {
  return drawn_near(method, count, [&](const Assignments& set) { return method.make(set)->parameters(); });
}

std::vector<Assignments> parameters_near_defaults(const SystemPlugin& system, int count) {
  return drawn_near(system, count, [&](const Assignments& set) { return system.make(set)->parameters(); });
}

std::vector<Assignments> parameters_near_defaults(const BracketPlugin& bracket, int count) {
  return drawn_near(bracket, count, [&](const Assignments& set) { return bracket.make(set).parameters; });
}

std::vector<Assignments> other_values(const MethodPlugin& method, const std::vector<Assignments>& instances) {
  constexpr double most_numbers = 8;
  std::vector<Assignments> list;
  const Assignments defaults = method.make({})->parameters();
  const auto known = [&](const std::string& name, const std::string& value) {
    const std::pair<std::string, std::string> setting(name, value);
    const auto has = [&](const Assignments& some) {
      return std::find(some.begin(), some.end(), setting) != some.end();
    };
    return has(defaults) || std::any_of(instances.begin(), instances.end(), has);
  };
  for (const Parameter& parameter : method.parameters()) {
    if (parameter.name == "compensated") continue;  // of core/integrator.hpp, which changes roundings alone
    std::vector<std::string> values;
    if (parameter.kind == Parameter::Kind::choice) values = parameter.choices;
    if (parameter.kind == Parameter::Kind::integer && parameter.maximum - parameter.minimum < most_numbers)
      for (int n = static_cast<int>(parameter.minimum); n <= static_cast<int>(parameter.maximum); ++n)
        values.push_back(std::to_string(n));
    for (const std::string& value : values) {
      if (known(parameter.name, value)) continue;
      try {
        (void)method.make({{parameter.name, value}});
        list.push_back({{parameter.name, value}});
      } catch (const InputError&) {
        continue;  // what the author refuses is claimed by nobody
      }
    }
  }
  return list;
}

}  // namespace pfaff
