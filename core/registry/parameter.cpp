#include <pfaff/core/registry/parameter.hpp>

#include <algorithm>
#include <charconv>

#include <pfaff/core/registry/range_text.hpp>

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

namespace {
std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  });
}

// The parts of a text between the commas outside of parentheses; nullopt where parentheses do not match.
std::optional<std::vector<std::string_view>> top_level_parts(std::string_view text) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  int depth = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '(') ++depth;
    if (text[k] == ')' && --depth < 0) return std::nullopt;
    if (text[k] != ',' || depth > 0) continue;
    parts.push_back(text.substr(begin, k - begin));
    begin = k + 1;
  }
  if (depth != 0) return std::nullopt;
  parts.push_back(text.substr(begin));
  return parts;
}
}  // namespace

bool is_set(const Assignments& assignments, std::string_view key) {
  return std::any_of(assignments.begin(), assignments.end(),
                     [&](const auto& assignment) { return assignment.first == key; });
}

namespace {
// How many parentheses are open at once.
int depth_of(std::string_view text) {
  int depth = 0, deepest = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    deepest = std::max(deepest, depth);
  }
  return deepest;
}
}  // namespace

PluginValue parse_plugin_value(const std::string& text, const std::string& what) {
  // Each level is made by a call within that of the level around it.
  constexpr int deepest = 8;
  if (depth_of(text) > deepest)
    throw InputError(what + ": expected at most " + std::to_string(deepest) +
                     " plug-ins inside one another, got '" + text.substr(0, 60) + "...'");
  const std::string refused = what + ": expected NAME or NAME(key=value, key=value), got '" + text + "'";
  const std::string_view whole = trimmed(text);
  const std::size_t open = whole.find('(');
  PluginValue value{std::string(trimmed(whole.substr(0, open)))};
  if (!is_name(value.name)) throw InputError(refused);
  if (open == std::string_view::npos) return value;
  if (whole.back() != ')') throw InputError(refused);
  const std::string_view inside = trimmed(whole.substr(open + 1, whole.size() - open - 2));
  const auto parts = top_level_parts(inside);
  if (!parts) throw InputError(refused);
  if (inside.empty()) return value;
  for (const std::string_view part : *parts) {
    const std::size_t equals = part.find('=');
    const std::string_view key = trimmed(part.substr(0, equals));
    if (equals != std::string_view::npos && is_name(key)) {
      if (is_set(value.settings, key))
        throw InputError(what + ": '" + std::string(key) + "' is set twice in '" + text +
                         "'; expected one value");
      value.settings.emplace_back(key, trimmed(part.substr(equals + 1)));
    } else if (!value.settings.empty() && !trimmed(part).empty()) {  // the comma belongs to a list of numbers
      value.settings.back().second += "," + std::string(trimmed(part));
    } else {
      throw InputError(refused);
    }
  }
  return value;
}

std::string to_string(const PluginValue& value) {
  std::string text;
  for (const auto& [key, setting] : value.settings)
    text.append(text.empty() ? "" : ", ").append(key).append("=").append(setting);
  return value.name + (text.empty() ? "" : "(" + text + ")");
}

bool Parameter::takes(std::string_view key) const {
  return key == name || (kind == Kind::plugin && key.starts_with(name + "."));
}

std::string range_text(const Range& range, const std::string& unit) {
  return number(range[0]) + " .. " + number(range[1]) + (unit.empty() ? "" : " " + unit);
}

std::string range_of(const Parameter& p) {
  if (p.kind == Parameter::Kind::file) return "FILE";
  if (p.kind == Parameter::Kind::text) return p.choices.front();
  if (p.kind == Parameter::Kind::choice || p.kind == Parameter::Kind::plugin) {
    std::string text;
    for (const std::string& choice : p.kind == Parameter::Kind::plugin ? p.plugins.names() : p.choices)
      text += (text.empty() ? "" : "|") + choice;
    return text;
  }
  return range_text({p.minimum, p.maximum}, p.unit);
}

namespace {
// Refuses what is no value of the parameter. Files, texts and plug-ins are looked at by those that read them.
void check(const Parameter& p, const std::string& text, std::string_view owner, const char* whose = "") {
  const auto refuse = [&](const std::string& expected) {
    throw InputError("parameter '" + p.name + "' of " + std::string(owner) + ": expected " + expected +
                     range_of(p) + ", got " + whose + "'" + text + "'" +
                     (p.meaning.empty() || p.kind == Parameter::Kind::choice ? "" : " (" + p.meaning + ")"));
  };
  const auto in_range = [&](const Real& x) { return x.value() >= p.minimum && x.value() <= p.maximum; };
  if (p.kind == Parameter::Kind::choice) {
    if (std::find(p.choices.begin(), p.choices.end(), text) == p.choices.end()) refuse("");
  } else if (p.kind == Parameter::Kind::list) {
    const auto numbers = parse_list(text);
    if (!numbers || !std::all_of(numbers->begin(), numbers->end(), in_range))
      refuse("numbers separated by commas, each in ");
  } else if (p.kind == Parameter::Kind::integer) {
    int whole = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), whole);
    if (error != std::errc() || end != text.data() + text.size() || whole < p.minimum || whole > p.maximum)
      refuse("an integer in ");
  } else if (p.kind == Parameter::Kind::real) {
    const auto value = Real::parse(text);
    if (!value || !in_range(*value)) refuse("a number in ");
  }
}
}  // namespace

void Parameter::assign(void* object, const std::string& text, std::string_view owner) const {
  if (kind == Kind::plugin) {
    PluginValue value = parse_plugin_value(
        text, "parameter '" + name + "' of " + std::string(owner) + ", of kind " + plugins.kind);
    value.settings = plugins.resolve(value);
    write(object, to_string(value));
    return;
  }
  check(*this, text, owner);
  write(object, text);
}

void assign_all(const std::vector<Parameter>& parameters, void* object, const Assignments& assignments,
                const std::string& owner) {
  for (const Parameter& p : parameters) {
    if (is_set(assignments, p.name)) continue;
    const std::string value = p.read(object);
    const bool open = p.kind == Parameter::Kind::choice && value.empty();  // until something is chosen
    if (!open) check(p, value, owner, "its default value ");
  }
  const auto parameter_of = [&](const std::string& key) -> const Parameter& {
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.takes(key); });
    if (found != parameters.end()) return *found;
    std::vector<std::string> names;
    for (const Parameter& p : parameters) names.push_back(p.name);
    throw InputError(unknown_name("parameter", key, names) + " (of " + owner + ")");
  };
  for (const auto& [key, text] : assignments)
    if (const Parameter& p = parameter_of(key); p.name == key) p.assign(object, text, owner);
  // name.KEY = value sets a parameter of the plug-in that name = value chooses, and may stand before it.
  // Therefore all plug-ins are chosen first, and their parameters set afterwards, outer ones before inner.
  Assignments within;
  for (const auto& assignment : assignments)
    if (parameter_of(assignment.first).name != assignment.first) within.push_back(assignment);
  std::stable_sort(within.begin(), within.end(), [](const auto& a, const auto& b) {
    const auto depth = [](const std::string& key) { return std::count(key.begin(), key.end(), '.'); };
    return depth(a.first) < depth(b.first);
  });
  for (const auto& [key, text] : within) {
    const Parameter& p = parameter_of(key);
    PluginValue value = parse_plugin_value(p.read(object), key);
    const std::string inner = key.substr(p.name.size() + 1);
    std::erase_if(value.settings, [&](const auto& setting) { return setting.first == inner; });
    value.settings.emplace_back(inner, text);
    p.assign(object, to_string(value), owner);
  }
}

Assignments resolved(const std::vector<Parameter>& parameters, const void* object) {
  Assignments values;
  for (const Parameter& p : parameters) values.emplace_back(p.name, p.read(object));
  return values;
}

}  // namespace pfaff

template class std::vector<pfaff::Parameter>;
