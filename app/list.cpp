// pfaff list: shows all plug-ins by kind and folder, and for each facet which plug-ins offer and need it. In
// Markdown the list is the page docs/plugins.md, that of integrators with what they keep docs/methods.md.
#include <algorithm>
#include <cctype>
#include <iostream>
#include <map>
#include <pfaff/bench/runner/json.hpp>
#include <set>

#include <pfaff/app/command.hpp>
#include <pfaff/app/method_survey.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/runs/kinds.hpp>

namespace pfaff::app {

namespace {
std::vector<std::string> listed_kinds() {
  std::vector<std::string> kinds = names_of_kinds();
  kinds.emplace_back("experiments");
  return kinds;
}

// The plug-ins of a kind with title and folder, in the order of folders.
template <class P>
nlohmann::json entries_of(const Registry<P>& registry, const std::string& room) {
  std::vector<nlohmann::json> entries;
  for (const P* plugin : registry.all())
    entries.push_back({{"name", plugin->name()},
                       {"title", plugin->descriptor().title},
                       {"folder", folder_of(*plugin, room)}});
  std::stable_sort(entries.begin(), entries.end(), [](const auto& one, const auto& other) {
    return one["folder"].template get<std::string>() < other["folder"].template get<std::string>();
  });
  return entries;
}

nlohmann::json entries_of_kind(const std::string& kind) {
  nlohmann::json entries = nlohmann::json::array();
  for_each_kind([&](const char*, const char* several, const auto& registry) {
    if (kind == several) entries = entries_of(registry, kind);
  });
  if (kind == "integrators") {
    const SurveyedSystems known;
    for (auto& entry : entries) {
      const MethodSurvey survey = known.of(*integrators().find(entry["name"].get<std::string>()), {{}});
      entry["orders"] = survey.orders;
      entry["preserves"] = nlohmann::json::array();
      for (const auto& [claim, orders] : survey.kept) entry["preserves"].push_back(to_string(claim));
    }
  }
  if (kind == "experiments")
    for (const std::string& name : experiment_names())
      entries.push_back({{"name", name}, {"title", read_experiment(name, false).title}});
  return entries;
}

std::vector<std::string> names_of_kind(const std::string& kind) {
  if (kind == "experiments") return experiment_names();
  std::vector<std::string> names;
  for_each_kind([&](const char*, const char* several, const auto& registry) {
    if (kind == several) names = registry.names();
  });
  return names;
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
    if (const std::string_view operation = facet_table[k].operation; !operation.empty())
      j["formulas"].push_back({{"name", operation}, {"written", operation}});
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
std::string names_in(const nlohmann::json& names) {
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
  TableRows lines;
  for (const auto& facet : facets) {
    lines.push_back({"  " + facet["name"].get<std::string>(), facet["meaning"].get<std::string>()});
    lines.push_back({"    formulas", names_in(facet["formulas"])});
    lines.push_back({"    offered by", names_in(facet["offered_by"])});
    lines.push_back({"    needed by", names_in(facet["needed_by"])});
  }
  std::cout << "facets\n" << facts(lines);
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
void print_markdown(std::string heading, const Registry<P>& registry) {
  heading.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(heading.front())));
  std::cout << "\n## " << heading << "\n\n| Name | Title | What it is | Reference |\n|---|---|---|---|\n";
  for (const P* plugin : registry.all()) {
    const auto& d = plugin->descriptor();
    std::cout << "| `" << d.name << "` | " << cell(d.title) << " | " << cell(first_sentence(d.description))
              << " | " << cell(d.reference) << " |\n";
  }
}

int plugins_in_markdown() {
  std::cout
      << "# Plug-ins\n\nWhat is registered, kind by kind. This page is what `pfaff list --markdown` prints: "
         "write descriptors, not\nthis page. `pfaff describe NAME` says more, `pfaff cite NAME` gives the "
         "reference in full.\n";
  for_each_kind(
      [](const char*, const char* several, const auto& registry) { print_markdown(several, registry); });
  return 0;
}

// The matrix of methods and what they keep: the orders with which each claim is made on the systems of its
// scope, over the parameters that verification runs through.
int methods_in_markdown() {
  std::cout
      << "# Methods, what they keep, and their order\n\nThe orders with which a method claims to keep what "
         "the column says, on the systems of which the claim speaks. Orders are\nthose of the parameters "
         "that "
         "`pfaff verify --full` runs through; many methods have higher ones. A method without an\norder in a "
         "column claims nothing there, which is no proof that it keeps nothing. What the columns mean stands "
         "below.\nThis page is what `pfaff list integrators --markdown` prints.\n";
  const SurveyedSystems known;
  std::map<std::string, MethodSurvey> surveys;
  std::map<std::string, std::set<Claim>> columns;  // of each folder those that one of its methods claims
  for (const MethodPlugin* method : integrators().all()) {
    const MethodSurvey& survey = surveys[method->name()] = known.of(*method, method->instances(true));
    for (const auto& kept : survey.kept) columns[folder_of(*method, "integrators")].insert(kept.first);
  }
  std::string folder = "-";
  for (const auto& entry : entries_of(integrators(), "integrators")) {
    if (entry["folder"] != folder) {
      folder = entry["folder"];
      std::cout << "\n## " << folder << "\n\n| method | order |";
      for (const Claim claim : columns[folder]) std::cout << ' ' << to_string(claim) << " |";
      std::cout << "\n|---|---|";
      for (std::size_t k = 0; k < columns[folder].size(); ++k) std::cout << "---|";
      std::cout << '\n';
    }
    const auto name = entry["name"].get<std::string>();
    const MethodSurvey& survey = surveys[name];
    std::cout << "| `" << name << "` | " << in_words(survey.orders)
              << (survey.adaptive ? ", chooses its steps" : "") << " |";
    for (const Claim claim : columns[folder]) {
      const auto kept = survey.kept.find(claim);
      std::cout << ' ' << (kept == survey.kept.end() ? "" : in_words(kept->second) + " ") << '|';
    }
    std::cout << '\n';
  }
  std::cout
      << "\n## What the columns mean\n\n| claim | meaning | systems of which it speaks |\n|---|---|---|\n";
  for (const ClaimRow& row : claim_table)
    std::cout << "| " << row.name << " | " << cell(std::string(row.meaning)) << " | "
              << cell(std::string(row.scope)) << " |\n";
  return 0;
}

// A kind as text: its plug-ins under the names of their folders.
void print(const std::string& kind, const nlohmann::json& entries) {
  const bool methods = kind == "integrators";
  TableRows rows;
  if (methods) rows.push_back({kind, "order", "keeps", ""});
  std::string folder;
  for (const auto& entry : entries) {
    if (entry.value("folder", "") != folder) {
      folder = entry["folder"];
      rows.push_back({" " + folder});
    }
    rows.push_back({"  " + entry["name"].get<std::string>()});
    if (methods) {
      const auto orders = entry["orders"].get<std::set<int>>();
      rows.back().push_back(orders.empty() ? "-" : in_words(orders));
      rows.back().push_back(names_in(entry["preserves"]));
    }
    rows.back().push_back(entry["title"]);
  }
  std::cout << (methods ? table(rows) : kind + '\n' + facts(rows));
}

struct ListOptions {
  std::string kind;
  bool markdown = false, names = false;
};

int list(const ListOptions& options, bool json) {
  const std::string& kind = options.kind;
  const std::vector<std::string> kinds = listed_kinds();
  std::vector<std::string> known = kinds;
  known.emplace_back("facets");
  if (!kind.empty() && std::find(known.begin(), known.end(), kind) == known.end())
    throw InputError(unknown_name("kind", kind, known));
  if (options.markdown) {
    require_shipped_plugins();
    if (kind.empty()) return plugins_in_markdown();
    if (kind == "integrators") return methods_in_markdown();
    throw InputError("--markdown: expected no kind, or integrators, got '" + kind + "'");
  }
  if (options.names && kind == "facets")
    throw InputError("--names: expected a kind of plug-ins or experiments, got 'facets'");
  if (kind == "facets") return list_facets(json);
  nlohmann::json j{{"schema", 1}};
  for (const std::string& one : kinds) {
    if (!kind.empty() && one != kind) continue;
    if (options.names) {
      for (const std::string& name : names_of_kind(one)) std::cout << printable(name) << '\n';
      continue;
    }
    j[one] = entries_of_kind(one);
    if (!json) print(one, j[one]);
  }
  if (json) std::cout << json_text(j);
  if (kind.empty() || kind == "systems" || kind == "integrators") say_what_is_left_out();
  return 0;
}
}  // namespace

void add_list(CLI::App& app, Common& common, Action& action) {
  std::string types;
  for (const std::string& kind : listed_kinds()) types += kind + "|";
  CLI::App* sub = subcommand(app, common, "list", "List " + kinds_in_words() + " and experiments");
  auto options = std::make_shared<ListOptions>();
  sub->add_option("kind", options->kind, "What is listed; all kinds without, but for facets")
      ->type_name(types + "facets");
  sub->add_flag("--names", options->names, "The names alone, one a line")->excludes("--json");
  sub->add_flag("--markdown", options->markdown,
                "All plug-ins as a page of Markdown, or integrators and what they keep")
      ->excludes("--json")
      ->excludes("--names");
  sub->callback([=, &common, &action] { action = [=, &common] { return list(*options, common.json); }; });
}

}  // namespace pfaff::app
