// pfaff describe NAME: prints everything known about a plug-in or an experiment.
#include <algorithm>
#include <iostream>

#include <pfaff/app/command.hpp>
#include <pfaff/app/description.hpp>
#include <pfaff/bench/runner/terminal.hpp>

namespace pfaff::app {

namespace {

std::string text_of(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_null()) return "-";
  if (!value.is_array()) return value.dump();
  std::string joined;
  for (const auto& item : value) joined += (joined.empty() ? "" : ", ") + text_of(item);
  return joined;
}

// A unit as text, "1" where there is none, as in the header of series.csv.
std::string unit_of(const nlohmann::json& value) {
  const std::string unit = text_of(value);
  return unit.empty() ? "1" : unit;
}

// Prints a description: scalars as "key  value", the description as a paragraph, lists of objects as indented
// tables, lists of names joined to one line.
void print(const nlohmann::json& j) {
  TableRows scalars;
  for (const char* first : {"name", "kind", "title", "reference"})
    if (j.contains(first)) scalars.push_back({first, text_of(j[first])});
  for (const auto& [key, value] : j.items()) {
    if (key == "name" || key == "kind" || key == "title" || key == "reference" || key == "description" ||
        key == "schema" || (key.starts_with("integrators") && j.contains("methods")))
      continue;
    if (!value.is_array()) scalars.push_back({key, key == "time_unit" ? unit_of(value) : text_of(value)});
    if (value.is_array() && !value.empty() && value[0].is_string()) scalars.push_back({key, text_of(value)});
  }
  std::cout << facts(scalars);
  if (const std::string text = j.value("description", ""); !text.empty())
    std::cout << '\n' << paragraph(text);
  for (const auto& [key, value] : j.items()) {
    if (!value.is_array() || value.empty() || !value[0].is_object()) continue;
    std::cout << '\n' << key << '\n';
    std::vector<std::vector<std::string>> rows(1);
    std::vector<std::string> columns;  // in order of importance to the reader
    const auto has = [&rows_of = value](const char* column) {
      return std::any_of(rows_of.begin(), rows_of.end(),
                         [&](const auto& row) { return row.contains(column); });
    };
    for (const char* column : {"name", "symbol", "initial", "default", "range", "order", "formulation",
                               "expected", "origin", "unit", "title", "steps", "preserves", "meaning"})
      if (has(column) && !(column == std::string("unit") && has("range"))) columns.emplace_back(column);
    for (const std::string& column : columns) rows[0].push_back(rows[0].empty() ? "  " + column : column);
    for (const auto& item : value) {
      std::vector<std::string> row;
      for (const std::string& column : columns) {
        const nlohmann::json of_item = item.value(column, nlohmann::json());
        const std::string cell = column == "unit" ? unit_of(of_item) : text_of(of_item);
        row.push_back(row.empty() ? "  " + cell : cell);
      }
      rows.push_back(row);
    }
    std::cout << table(rows);
  }
}

}  // namespace

void add_describe(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "describe", "Everything about a plug-in or an experiment");
  auto name = std::make_shared<std::string>();
  sub->add_option("name", *name, "Its name, as in pfaff list, or the file of one written as text")
      ->type_name("NAME|FILE")
      ->required();
  sub->callback([name, &common, &action] {
    action = [name, &common] {
      const std::vector<nlohmann::json> found = describe(*name);
      if (common.json) {
        // The first description is the object itself; others of the same name are listed in it under "also".
        nlohmann::json j = found.front();
        j["schema"] = 1;
        for (std::size_t k = 1; k < found.size(); ++k) j["also"].push_back(found[k]);
        std::cout << json_text(j);
      } else {
        for (std::size_t k = 0; k < found.size(); ++k) {
          if (k > 0) std::cout << '\n';
          print(found[k]);
        }
      }
      say_what_is_left_out();
      return 0;
    };
  });
}

}  // namespace pfaff::app
