// pfaff list: what there is, by kind.
#include <iostream>
#include <nlohmann/json.hpp>

#include <pfaff/app/command.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/runner/experiment.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/formulation.hpp>

namespace pfaff::app {

namespace {
using Rows = std::vector<std::pair<std::string, std::string>>;  // name, title

template <class P>
Rows rows_of(const Registry<P>& registry) {
  Rows rows;
  for (const P* plugin : registry.all()) rows.emplace_back(plugin->name(), plugin->descriptor().title);
  return rows;
}

Rows rows_of_kind(const std::string& kind) {
  if (kind == "systems") return rows_of(systems());
  if (kind == "integrators") return rows_of(integrators());
  if (kind == "brackets") return rows_of(brackets());
  if (kind == "formulations") return rows_of(formulations());
  Rows rows;
  for (const std::string& name : experiment_names())
    rows.emplace_back(name, read_experiment(name, false).title);
  return rows;
}

int list(const std::string& kind, bool json) {
  const std::vector<std::string> kinds{"systems", "integrators", "brackets", "formulations", "experiments"};
  if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw InputError(unknown_name("kind", kind, kinds));
  nlohmann::json j{{"schema", 1}};
  for (const std::string& k : kinds) {
    if (!kind.empty() && k != kind) continue;
    const Rows rows = rows_of_kind(k);
    j[k] = nlohmann::json::array();
    std::vector<std::vector<std::string>> lines;
    for (const auto& [name, title] : rows) {
      j[k].push_back({{"name", name}, {"title", title}});
      lines.push_back({"  " + name, title});
    }
    if (!json) std::cout << k << '\n' << table(lines);
  }
  if (json) std::cout << j.dump(1) << '\n';
  return 0;
}
}  // namespace

void add_list(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub =
      subcommand(app, common, "list", "List systems, integrators, brackets, formulations and experiments");
  auto kind = std::make_shared<std::string>();
  sub->add_option("kind", *kind, "systems, integrators, brackets, formulations, experiments; all without")
      ->type_name("KIND");
  sub->callback([kind, &common, &action] { action = [kind, &common] { return list(*kind, common.json); }; });
}

}  // namespace pfaff::app
