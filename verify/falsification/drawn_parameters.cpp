#include <pfaff/verify/falsification/drawn_parameters.hpp>

#include <algorithm>
#include <random>

namespace pfaff {

namespace {

constexpr int attempts_for_each = 8;

// A value for the parameter; empty where it stays as it is.
std::string drawn(const Parameter& parameter, std::mt19937_64& random) {
  const auto below = [&](std::size_t limit) { return random() % limit; };
  const auto one_of = [&](const std::vector<std::string>& names) {
    return names.empty() ? std::string() : names[below(names.size())];
  };
  switch (parameter.kind) {
    case Parameter::Kind::integer: {
      const auto range = static_cast<std::size_t>(parameter.maximum - parameter.minimum);
      const std::size_t above = below(std::size_t{1} << (1 + below(4)));
      return std::to_string(static_cast<long>(parameter.minimum) + static_cast<long>(std::min(above, range)));
    }
    case Parameter::Kind::real: {
      const double share = static_cast<double>(below(9)) / 8;
      return to_string(Quad(parameter.minimum + share * (parameter.maximum - parameter.minimum)), 17);
    }
    case Parameter::Kind::choice:
      return one_of(parameter.choices);
    case Parameter::Kind::plugin:
      return one_of(parameter.plugins.names());
    default:
      return {};
  }
}

// Every parameter with its value, or nothing where the method refuses the settings.
Assignments resolved_by(const MethodPlugin& plugin, const Assignments& settings) {
  try {
    return plugin.make(settings)->parameters();
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

std::vector<Assignments> drawn_parameters(const MethodPlugin& plugin, const std::vector<Assignments>& known,
                                          std::uint64_t seed, int count) {
  std::vector<Assignments> list, met;
  for (const Assignments& settings : known) met.push_back(resolved_by(plugin, settings));
  std::mt19937_64 random(seed);
  for (int k = 0; k < attempts_for_each * count && list.size() < static_cast<std::size_t>(count); ++k) {
    Assignments settings;
    for (const Parameter& parameter : plugin.parameters())
      if (std::string value = drawn(parameter, random); !value.empty())
        settings.emplace_back(parameter.name, std::move(value));
    const Assignments all = settings.empty() ? Assignments() : resolved_by(plugin, settings);
    if (all.empty() || std::find(met.begin(), met.end(), all) != met.end()) continue;
    met.push_back(all);
    list.push_back(std::move(settings));
  }
  return list;
}

}  // namespace pfaff
