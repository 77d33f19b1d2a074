// pfaff list: shows all plug-ins by kind, and for each facet which plug-ins offer and need it. In Markdown
// the list is the page docs/plugins.md.
#include <iostream>
#include <map>
#include <pfaff/bench/runner/json.hpp>

#include <pfaff/app/command.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

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

// The names of the plug-ins of a kind for which holds(plugin) is true.
template <class P, class Holds>
nlohmann::json names_where(const Registry<P>& registry, const Holds& holds) {
  nlohmann::json names = nlohmann::json::array();
  for (const P* plugin : registry.all())
    if (holds(*plugin)) names.push_back(plugin->name());
  return names;
}

// Every facet with the formulas that make it, the systems that offer it with their own parameters, and the
// integrators and formulations that cannot do without it.
nlohmann::json facet_list() {
  nlohmann::json list = nlohmann::json::array();
  std::map<std::string, FacetSet> offered;
  for (const SystemPlugin* system : systems().all()) offered[system->name()] = system->make({})->facets();
  for (unsigned k = 0; k < static_cast<unsigned>(Facet::count); ++k) {
    const auto facet = static_cast<Facet>(k);
    nlohmann::json j{{"name", to_string(facet)},
                     {"meaning", facet_table[k].meaning},
                     {"formulas", nlohmann::json::array()}};
    for (const FormulaRow& row : formula_table)
      if (row.traits.offered_by.has(facet) || row.traits.part_of.has(facet))
        j["formulas"].push_back({{"name", row.name}, {"written", row.written}});
    j["offered_by"] =
        names_where(systems(), [&](const SystemPlugin& s) { return offered[s.name()].has(facet); });
    j["needed_by"] =
        names_where(integrators(), [&](const MethodPlugin& m) { return m.make({})->needs().has(facet); });
    for (auto& name :
         names_where(formulations(), [&](const FormulationPlugin& f) { return f.needs().has(facet); }))
      j["needed_by"].push_back(name);
    list.push_back(j);
  }
  return list;
}
std::string joined(const nlohmann::json& names) {
  std::string text;
  for (const auto& name : names)
    text += (text.empty() ? "" : ", ") + (name.is_string() ? name : name["name"]).get<std::string>();
  return text.empty() ? "-" : text;
}
int list_facets(bool json) {
  const nlohmann::json facets = facet_list();
  if (json) {
    std::cout << json_text({{"schema", 1}, {"facets", facets}});
    return 0;
  }
  std::vector<std::vector<std::string>> lines;
  for (const auto& facet : facets) {
    lines.push_back({"  " + facet["name"].get<std::string>(), facet["meaning"].get<std::string>()});
    lines.push_back({"    formulas", joined(facet["formulas"])});
    lines.push_back({"    offered by", joined(facet["offered_by"])});
    lines.push_back({"    needed by", joined(facet["needed_by"])});
  }
  std::cout << "facets\n" << table(lines);
  return 0;
}

// Text as it is shown in a cell of a Markdown table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : printable(text)) {
    if (std::string_view("|*_<").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string first_sentence(const std::string& text) {
  const std::size_t end = text.find(". ");
  return end == std::string::npos ? text : text.substr(0, end + 1);
}

template <class P>
void print_markdown(const std::string& heading, const Registry<P>& registry) {
  std::cout << "\n## " << heading << "\n\n| Name | Title | What it is | Reference |\n|---|---|---|---|\n";
  for (const P* plugin : registry.all()) {
    const auto& d = plugin->descriptor();
    std::cout << "| `" << d.name << "` | " << cell(d.title) << " | " << cell(first_sentence(d.description))
              << " | " << cell(d.reference) << " |\n";
  }
}

int list_markdown() {
  std::cout
      << "# Plug-ins\n\nWhat is registered, kind by kind. This page is what `pfaff list --markdown` prints: "
         "write descriptors, not\nthis page. `pfaff describe NAME` says more, `pfaff cite NAME` gives the "
         "reference in full.\n";
  print_markdown("Systems", systems());
  print_markdown("Integrators", integrators());
  print_markdown("Brackets", brackets());
  print_markdown("Formulations", formulations());
  return 0;
}

int list(const std::string& kind, bool json) {
  if (kind == "facets") return list_facets(json);
  const std::vector<std::string> kinds{"systems", "integrators", "brackets", "formulations", "experiments"};
  if (!kind.empty() && std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
    std::vector<std::string> names = kinds;
    names.emplace_back("facets");
    throw InputError(unknown_name("kind", kind, names));
  }
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
  if (json) std::cout << json_text(j);
  return 0;
}
}  // namespace

void add_list(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub =
      subcommand(app, common, "list", "List systems, integrators, brackets, formulations and experiments");
  auto kind = std::make_shared<std::string>();
  auto markdown = std::make_shared<bool>(false);
  auto* const of_kind =
      sub->add_option("kind", *kind, "systems, integrators, brackets, formulations, experiments, facets")
          ->type_name("KIND");
  sub->add_flag("--markdown", *markdown, "All plug-ins as a page of Markdown")
      ->excludes(of_kind)
      ->excludes("--json");
  sub->callback([=, &common, &action] {
    action = [=, &common] { return *markdown ? list_markdown() : list(*kind, common.json); };
  });
}

}  // namespace pfaff::app
