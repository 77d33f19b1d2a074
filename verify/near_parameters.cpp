#include <pfaff/verify/near_parameters.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

namespace pfaff {

namespace {
// A value of a number in its range, or the given one of what is no real number.
std::string value_near(const Parameter& parameter, const std::string& given, std::mt19937_64& random) {
  const auto number = Real::parse(given);
  if (parameter.kind != Parameter::Kind::real || !number) return given;
  const std::uint64_t eighths =
      random() % 8;  // of the range of what is drawn, but for the four that are the default
  const double share = static_cast<double>(eighths < 4 ? eighths : eighths + 1) / 8, value = number->value();
  const double side =
      parameter.maximum > 0 ? std::min(1.0, parameter.maximum) : std::max(-1.0, parameter.minimum);
  const double wanted = value == 0 ? side * (share + 0.25) : value * (0.625 + 0.75 * share);
  return to_string(Quad(std::clamp(wanted, parameter.minimum, parameter.maximum)), 6);
}

// The next whole number in the range of a parameter; the given value of what is none.
std::string next_number(const Parameter& parameter, const std::string& given) {
  const auto number = Real::parse(given);
  const bool of_numbers =
      parameter.kind == Parameter::Kind::integer || parameter.kind == Parameter::Kind::real;
  if (!of_numbers || !number || number->value() != std::round(number->value()) ||
      !(number->value() + 1 <= parameter.maximum && std::abs(number->value()) < 1e6))
    return given;
  return std::to_string(static_cast<long>(number->value()) + 1);
}

// `parameters_with` gives all parameters of the plug-in as it is made with some; InputError where it refuses
// them. In the last of the sets counts are others too, where `of_counts`: whole numbers, which of texts have
// the kind of all others and are known by being refused where they are none.
template <class P, class Made>
std::vector<Assignments> drawn_near(const P& plugin, int count, bool of_counts, const Made& parameters_with) {
  std::vector<Assignments> list;
  const Assignments defaults = parameters_with({});
  std::mt19937_64 random(20050);
  const auto accepted = [&](const Assignments& drawn) {
    try {
      return !drawn.empty() && !parameters_with(drawn).empty();
    } catch (const InputError&) {
      return false;  // what the author refuses is claimed by nobody
    }
  };
  for (int k = 0; k < count; ++k) {
    Assignments drawn, counts;
    for (const Parameter& parameter : plugin.parameters())
      for (const auto& [name, value] : defaults) {
        if (name != parameter.name) continue;
        std::string near = value_near(parameter, value, random), next = next_number(parameter, value);
        if (near != value && (!of_counts || accepted({{name, near}}))) {
          drawn.emplace_back(name, std::move(near));
        } else if (of_counts && k == count - 1 && next != value) {
          counts.emplace_back(name, std::move(next));
        }
      }
    Assignments with_counts = drawn;
    with_counts.insert(with_counts.end(), counts.begin(), counts.end());
    if (accepted(with_counts)) {
      list.push_back(std::move(with_counts));
    } else if (accepted(drawn)) {
      list.push_back(std::move(drawn));
    }
  }
  return list;
}
}  // namespace

std::vector<Assignments> parameters_near_defaults(const MethodPlugin& method, int count) {
  return drawn_near(method, count, false,
                    [&](const Assignments& set) { return method.make(set)->parameters(); });
}

std::vector<Assignments> parameters_near_defaults(const SystemPlugin& system, int count) {
  return drawn_near(system, count, true,
                    [&](const Assignments& set) { return system.make(set)->parameters(); });
}

std::vector<Assignments> parameters_near_defaults(const BracketPlugin& bracket, int count) {
  return drawn_near(bracket, count, false,
                    [&](const Assignments& set) { return bracket.make(set).parameters; });
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
