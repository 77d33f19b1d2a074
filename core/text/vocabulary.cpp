#include <pfaff/core/text/vocabulary.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>

#include <pfaff/core/text/lexer.hpp>

namespace pfaff::text {

namespace {
using Kind = Item::Kind;

// The text of a key that may be missing.
std::string optional_label(Table& table, const std::string& key) {
  const Item* value = table.find(key);
  return value == nullptr ? "" : label_of(*value, key);
}

Real constant_of(const Item& value, const std::string& what) {
  return Scope().constant(expression_of(value, what));
}

// The range of what is called `what`, where the table has one.
Range optional_range(Table& table, const std::string& what) {
  const Item* range = table.find("range");
  if (range == nullptr) return unbounded;
  if (range->kind != Kind::list || range->items.size() != 2)
    refuse(*range, "range of " + what + ": expected [smallest, largest]");
  const Range bounds{constant_of(range->items[0], "range").value(),
                     constant_of(range->items[1], "range").value()};
  if (!(bounds[0] <= bounds[1]))
    refuse(*range, "range of " + what + ": expected the smallest before the largest");
  return bounds;
}

TextParameter read_parameter(const Member& member) {
  TextParameter p;
  p.name = member.key;
  p.minimum = unbounded[0];
  p.maximum = unbounded[1];
  const std::string what = "parameter '" + p.name + "'";
  if (member.value.kind != Kind::table) {
    p.value = constant_of(member.value, what);
    return p;
  }
  Table table(member.value, what);
  p.value = constant_of(table.required("value"), "value");
  p.unit = optional_label(table, "unit");
  p.meaning = table.text("meaning");
  const Range bounds = optional_range(table, what);
  p.minimum = bounds[0];
  p.maximum = bounds[1];
  if (!(p.minimum <= p.value.value() && p.value.value() <= p.maximum))
    refuse(*table.find("range"), what + ": its value " + to_string(p.value) + " is not in its range");
  table.finish();
  return p;
}

}  // namespace

void TakenNames::take(const Source& place, const std::string& name, const std::string& what) {
  if (!is_identifier(name))
    refuse(place, 0, what + " '" + name + "': expected a letter or _, then letters, digits and _");
  const auto& reserved = reserved_names();
  bool meant = std::find(reserved.begin(), reserved.end(), name) != reserved.end();
  for (const std::string_view other : {"initial", "t0", "elapsed"}) meant = meant || name == other;
  if (meant) refuse(place, 0, what + " '" + name + "': this name has a meaning of its own; expected another");
  for (const auto& [other, is] : taken_)
    if (other == name)
      refuse(place, 0, what + " '" + name + "' has the name of a " + is + "; expected another");
  taken_.emplace_back(name, what);
}

std::vector<TextParameter> read_parameters(const Item& value, TakenNames& names) {
  if (value.kind != Kind::table) refuse(value, "parameters: expected a table");
  std::vector<TextParameter> list;
  for (const Member& member : value.members) {
    names.take(member.place, member.key, "parameter");
    list.push_back(read_parameter(member));
  }
  return list;
}

std::vector<TextCoordinate> read_coordinates(const Item& value, TakenNames& names) {
  std::vector<TextCoordinate> list;
  if (value.kind == Kind::list) {
    for (const Item& item : value.items) {
      if (item.kind == Kind::table) {
        Table table(item, "coordinate");
        const Item& name = table.required("name");
        const std::string called = text_of(name, "name");
        list.push_back({called,
                        optional_label(table, "unit"),
                        {},
                        name.source,
                        optional_range(table, "coordinate '" + called + "'")});
        table.finish();
      } else {
        list.push_back({text_of(item, "coordinates"), "", {}, item.source});
      }
    }
  } else if (value.kind == Kind::table) {
    for (const auto& [key, place, item] : value.members) {
      if (item.kind == Kind::table) {
        Table table(item, "coordinates '" + key + "'");
        list.push_back({key, optional_label(table, "unit"), expression_of(table.required("count"), "count"),
                        place, optional_range(table, "coordinates '" + key + "'")});
        table.finish();
      } else {
        list.push_back({key, "", expression_of(item, "coordinates '" + key + "'"), place});
      }
    }
  } else {
    refuse(value, "coordinates: expected a list of names, or a table such as { q = \"n\", p = \"n\" }");
  }
  for (const TextCoordinate& c : list) names.take(c.place, c.name, "coordinate");
  if (list.empty()) refuse(value, "coordinates: expected one at least");
  return list;
}

std::vector<TextDefinition> read_definitions(const Item& value, TakenNames& names) {
  if (value.kind != Kind::table) refuse(value, "let: expected a table");
  std::vector<TextDefinition> list;
  for (const auto& [key, place, item] : value.members) {
    names.take(place, key, "definition");
    const bool is_list = item.kind == Kind::list;
    list.push_back(
        {key, is_list ? expressions_of(item, key) : std::vector{expression_of(item, key)}, is_list});
  }
  return list;
}

std::string label_of(const Item& value, const std::string& what) {
  const std::string& text = text_of(value, what);
  const auto odd = [](char c) {
    return static_cast<unsigned char>(c) < 0x20U || c == 0x7F || c == '"' || c == ',';
  };
  if (std::any_of(text.begin(), text.end(), odd))
    refuse(value, what + ": expected a text without commas, quotation marks and line breaks");
  return text;
}

std::vector<Real> default_values(const std::vector<TextParameter>& parameters) {
  std::vector<Real> values;
  for (const TextParameter& p : parameters) values.push_back(p.value);
  return values;
}

std::vector<Parameter> plugin_parameters(const std::vector<TextParameter>& parameters) {
  using Values = std::vector<Real>;
  std::vector<Parameter> list;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    Parameter p;
    p.name = parameters[k].name;
    p.unit = parameters[k].unit;
    p.meaning = parameters[k].meaning;
    p.minimum = parameters[k].minimum;
    p.maximum = parameters[k].maximum;
    p.write = [k](void* object, const std::string& text) {
      (*static_cast<Values*>(object))[k] = *Real::parse(text);
    };
    p.read = [k](const void* object) { return to_string((*static_cast<const Values*>(object))[k]); };
    list.push_back(std::move(p));
  }
  return list;
}

void define(Scope& scope, const std::vector<TextParameter>& parameters, const std::vector<Real>& values,
            const std::vector<TextDefinition>& definitions) {
  for (std::size_t k = 0; k < values.size(); ++k) scope.define(parameters[k].name, Recorded(values[k]));
  for (const TextDefinition& definition : definitions) {
    if (definition.is_list) {
      scope.define(definition.name, definition.expressions);
    } else {
      scope.define(definition.name, definition.expressions.front());
    }
  }
}

std::size_t count_of(const TextCoordinate& coordinate, const Scope& scope) {
  if (!coordinate.count) return 1;
  constexpr int most = 100000;
  Scope copy = scope;
  const int count = copy.whole_number(*coordinate.count);
  if (count < 1 || count > most)
    refuse(coordinate.count->source(), 0,
           "there are " + std::to_string(count) + " coordinates '" + coordinate.name + "'; expected 1 .. " +
               std::to_string(most));
  return static_cast<std::size_t>(count);
}

bool is_text_file(std::string_view name) { return name.ends_with(".toml"); }

std::string beside(const std::string& file, const std::string& other) {
  const std::filesystem::path path = file;
  return path.is_absolute() ? file : (std::filesystem::path(other).parent_path() / path).string();
}

}  // namespace pfaff::text
