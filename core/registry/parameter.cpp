#include <pfaff/core/registry/parameter.hpp>

#include <algorithm>
#include <charconv>

namespace pfaff {

namespace {
std::string number(double x) {
  std::string text(32, '\0');
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  text.resize(static_cast<std::size_t>(end - text.data()));
  return text;
}
}  // namespace

std::optional<std::vector<Real>> parse_list(std::string_view text) {
  std::vector<Real> numbers;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const auto number = Real::parse(text.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
    if (text.empty()) return std::nullopt;
  }
  return numbers;
}

std::string range_of(const Parameter& p) {
  if (p.kind == Parameter::Kind::file) return "FILE";
  if (p.kind == Parameter::Kind::choice) {
    std::string text;
    for (const std::string& choice : p.choices) text += (text.empty() ? "" : "|") + choice;
    return text;
  }
  return number(p.minimum) + " .. " + number(p.maximum) + (p.unit.empty() ? "" : " " + p.unit);
}

void Parameter::assign(void* object, const std::string& text, std::string_view owner) const {
  const auto refuse = [&](const std::string& expected) {
    throw InputError("parameter '" + name + "' of " + std::string(owner) + ": expected " + expected + " in " +
                     range_of(*this) + ", got '" + text + "'");
  };
  if (kind == Kind::file) {
    write(object, text);
    return;
  }
  if (kind == Kind::choice) {
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      throw InputError("parameter '" + name + "' of " + std::string(owner) + ": expected " + range_of(*this) +
                       ", got '" + text + "'");
    write(object, text);
    return;
  }
  const auto in_range = [this](const Real& x) { return x.value() >= minimum && x.value() <= maximum; };
  if (kind == Kind::list) {
    const auto numbers = parse_list(text);
    if (!numbers || !std::all_of(numbers->begin(), numbers->end(), in_range))
      refuse("numbers separated by commas, each");
    write(object, text);
    return;
  }
  const auto value = Real::parse(text);
  if (kind == Kind::integer) {
    int whole = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
    if (error != std::errc() || end != text.data() + text.size() || whole < minimum || whole > maximum)
      refuse("an integer");
    write(object, text);
    return;
  }
  if (!value || !in_range(*value)) refuse("a number");
  write(object, text);
}

void assign_all(const std::vector<Parameter>& parameters, void* object, const Assignments& assignments,
                const std::string& owner) {
  for (const auto& [key, text] : assignments) {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&key = key](const Parameter& p) { return p.name == key; });
    if (found == parameters.end()) {
      std::vector<std::string> names;
      for (const Parameter& p : parameters) names.push_back(p.name);
      throw InputError(unknown_name("parameter", key, names) + " (of " + owner + ")");
    }
    found->assign(object, text, owner);
  }
}

Assignments resolved(const std::vector<Parameter>& parameters, const void* object) {
  Assignments values;
  for (const Parameter& p : parameters) values.emplace_back(p.name, p.read(object));
  return values;
}

}  // namespace pfaff
