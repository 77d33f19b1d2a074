// pfaff describe NAME and pfaff cite NAME: show everything known about a plug-in or an experiment, and its
// references.
#include <algorithm>
#include <iostream>
#include <pfaff/bench/runner/json.hpp>

#include <pfaff/app/command.hpp>
#include <pfaff/app/terminal.hpp>
#include <pfaff/bench/experiment/automatic_steps.hpp>
#include <pfaff/bench/experiment/citations.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/motion.hpp>
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/facets/derivations/derivation.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff::app {

namespace {

nlohmann::json parameters_of(const Plugin& plugin, const Assignments& defaults) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t k = 0; k < plugin.parameters().size(); ++k) {
    const Parameter& p = plugin.parameters()[k];
    list.push_back({{"name", p.name},
                    {"default", defaults[k].second},
                    {"range", range_of(p)},
                    {"unit", p.unit},
                    {"meaning", p.meaning}});
  }
  return list;
}

// The keys of references.bib that are cited: the reference of a plug-in is a text with keys in it, that of an
// experiment a list of keys. InputError where a key is not there, and where a text holds none.
std::vector<std::string> keys_of(const nlohmann::json& described) {
  const std::string who = described["kind"].get<std::string>() + " " + described["name"].get<std::string>();
  const nlohmann::json& reference = described["reference"];
  if (!reference.is_array()) {
    std::vector<std::string> keys = keys_in(reference);
    if (keys.empty())
      throw InputError(who + ": its reference '" + reference.get<std::string>() +
                       "' holds no key of references.bib");
    return keys;
  }
  for (const auto& key : reference)
    if (bibtex(key).empty())
      throw InputError(who + ": " +
                       unknown_name("key of references.bib", key.get<std::string>(), citation_keys()));
  return reference;
}

// The formulations that fit a system with constraints.
nlohmann::json formulations_of(const std::shared_ptr<const Model>& model) {
  nlohmann::json names = nlohmann::json::array();
  for (const FormulationPlugin* formulation : formulations().all())
    if (formulation->refuses(*model).empty()) names.push_back(formulation->name());
  return names;
}

// The formulas that make what a model offers, and all that its author wrote: for each whether it is written,
// and if not, what it is derived from.
nlohmann::json formulas_of(const Model& model) {
  nlohmann::json list = nlohmann::json::array();
  for (const FormulaRow& row : formula_table) {
    nlohmann::json j{{"name", row.name}};
    if (model.given(row.formula)) {
      j["origin"] = "written, " + std::string(row.written);
    } else {
      const Derivation* way = derivation_of(row.formula, model);
      if (way == nullptr ||
          !(model.facets().meets(row.traits.offered_by) || model.facets().meets(row.traits.part_of)))
        continue;
      std::string from;
      for (const Formula f : way->from)
        if (f != Formula::count) from += (from.empty() ? " from " : ", ") + std::string(to_string(f));
      j["origin"] = "derived" + from;
    }
    list.push_back(j);
  }
  return list;
}

nlohmann::json claims_on(const MethodInstance& method, const Model& model) {
  nlohmann::json claims = nlohmann::json::array();
  for (const Claim claim : claims_in_scope(method.preserves(model), model))
    claims.push_back(to_string(claim));
  return claims;
}

// The integrators that fit a system, with order and what they keep there: those that step on the system
// itself, and those for which a formulation makes a motion of it.
void add_methods(nlohmann::json& j, const std::shared_ptr<const Model>& model) {
  std::shared_ptr<const Model> motion;
  j["integrators"] = j["methods"] = nlohmann::json::array();
  if (model->restricted() && !j["formulations"].empty()) {
    motion = motion_of(model);
    j["integrators_of_formulations"] = nlohmann::json::array();
  }
  for (const MethodPlugin* method : integrators().all()) {
    const auto instance = method->make({});
    const bool itself = instance->refuses(*model).empty();
    if (!itself && (motion == nullptr || !instance->refuses(*motion).empty())) continue;
    const Model& on = itself ? *model : *motion;
    j[itself ? "integrators" : "integrators_of_formulations"].push_back(method->name());
    j["methods"].push_back(
        {{"name", method->name()}, {"order", instance->order(on)}, {"preserves", claims_on(*instance, on)}});
    if (motion != nullptr)
      j["methods"].back()["formulation"] =
          itself ? nlohmann::json(nullptr) : nlohmann::json(motion->source().formulation);
  }
}

nlohmann::json describe_system(const SystemPlugin& plugin) {
  const auto model = plugin.make({});
  nlohmann::json j{{"kind", "system"},
                   {"name", plugin.name()},
                   {"title", plugin.descriptor().title},
                   {"reference", plugin.descriptor().reference},
                   {"description", plugin.descriptor().description},
                   {"dimension", model->dimension()},
                   {"time_unit", model->time_unit()},
                   {"facets", to_string(model->facets())},
                   {"autonomous", model->autonomous()},
                   {"parameters", parameters_of(plugin, model->parameters())},
                   {"formulas", formulas_of(*model)}};
  for (std::size_t k = 0; k < model->coordinates().size(); ++k)
    j["coordinates"].push_back(
        {{"name", model->coordinates()[k].name},
         {"unit", model->coordinates()[k].unit},
         {"initial", k < model->initial().size() ? nlohmann::json(to_string(model->initial()[k]))
                                                 : nlohmann::json(nullptr)}});
  j["invariants"] = nlohmann::json::array();
  for (const Invariant& i : model->invariants())
    j["invariants"].push_back({{"name", i.name}, {"unit", i.unit}, {"expected", to_string(i.behaviour)}});
  if (model->restricted()) {
    j["constraints"] = model->constraint_names();
    j["formulations"] = formulations_of(model);
  }
  add_methods(j, model);
  return j;
}

nlohmann::json describe_method(const MethodPlugin& plugin) {
  const auto method = plugin.make({});
  nlohmann::json j{{"kind", "integrator"},
                   {"name", plugin.name()},
                   {"title", plugin.descriptor().title},
                   {"reference", plugin.descriptor().reference},
                   {"description", plugin.descriptor().description},
                   {"needs", to_string(method->needs())},
                   {"adaptive", method->adaptive()},
                   {"parameters", parameters_of(plugin, method->parameters())}};
  if (const auto* table = dynamic_cast<const MethodTable*>(&plugin)) j["file"] = table->path();
  if (const auto theory = order_theory(plugin.name(), {})) {
    const auto conditions = theory->conditions(theory->coefficients);
    Quad worst(0);
    for (const OrderCondition& condition : conditions) worst = std::max(worst, relative_residual(condition));
    j["order_conditions"] = std::to_string(conditions.size()) + " by " + theory->kind + " up to order " +
                            std::to_string(theory->order) + ", fulfilled to " + to_scientific(worst, 2);
  }
  // A plug-in that is built on another fits other systems with another one.
  for (const Parameter& p : plugin.parameters()) {
    if (p.kind != Parameter::Kind::plugin) continue;
    for (const auto& [key, value] : method->parameters())
      if (key == p.name) j["systems_shown_for"] = key + "=" + value;
  }
  j["systems"] = nlohmann::json::array();
  for (const SystemPlugin* system : systems().all()) {
    const auto whole = system->make({}), model = motion_for(*method, whole);
    if (!method->refuses(*model).empty()) continue;
    j["systems"].push_back({{"name", system->name()},
                            {"order", method->order(*model)},
                            {"preserves", claims_on(*method, *model)}});
    if (model != whole) j["systems"].back()["formulation"] = model->source().formulation;
  }
  return j;
}

nlohmann::json describe_bracket(const BracketPlugin& plugin) {
  const BracketInstance bracket = plugin.make({});
  return {{"kind", "bracket"},
          {"name", plugin.name()},
          {"title", plugin.descriptor().title},
          {"reference", plugin.descriptor().reference},
          {"description", plugin.descriptor().description},
          {"dimension", bracket.dimension},
          {"symmetry", to_string(plugin.descriptor().symmetry)},
          {"jacobi", plugin.descriptor().jacobi},
          {"parameters", parameters_of(plugin, bracket.parameters)}};
}

nlohmann::json describe_formulation(const FormulationPlugin& plugin) {
  nlohmann::json j{{"kind", "formulation"},
                   {"name", plugin.name()},
                   {"title", plugin.descriptor().title},
                   {"reference", plugin.descriptor().reference},
                   {"description", plugin.descriptor().description},
                   {"parameters", parameters_of(plugin, plugin.resolve({}))}};
  const FormulationStatement statement = plugin.states({});
  j["reactions"] = to_string(statement.reactions);
  j["friction"] = to_string(statement.friction);
  j["keeps"] = nlohmann::json::array();
  for (const FormulationClaim claim : statement.keeps) j["keeps"].push_back(to_string(claim));
  j["systems"] = nlohmann::json::array();
  for (const SystemPlugin* system : systems().all())
    if (system->constrained() && plugin.refuses(*system->make({})).empty())
      j["systems"].push_back({{"name", system->name()}, {"title", system->descriptor().title}});
  return j;
}

nlohmann::json describe_experiment(const std::string& name) {
  Experiment e = read_experiment(name, false);
  std::erase(e.description, '$');  // which stand around equations
  nlohmann::json j{{"kind", "experiment"},
                   {"name", e.name},
                   {"title", e.title},
                   {"description", e.description},
                   {"reference", e.reference}};
  const std::vector<ExperimentRun> runs = expand(e);
  if (runs_with_automatic_steps(runs).empty()) j["runs"] = runs.size();  // else it is not known yet
  for (const ExperimentMethod& m : e.methods) j["methods"].push_back(m.label);
  for (const ExperimentCase& c : e.cases)
    j["cases"].push_back({{"name", c.name},
                          {"title", c.title},
                          {"steps", c.automatic ? nlohmann::json("auto") : nlohmann::json(c.steps)}});
  if (!e.derivation) return j;
  j["runs"] = e.derivation->size();
  for (const DerivationSweep& sweep : e.derivation->sweeps) j["methods"].push_back(sweep.method);
  return j;
}

// Descriptions of everything named `name`. A system and an experiment may share a name; the plug-in comes
// first.
std::vector<nlohmann::json> describe(const std::string& name,
                                     const std::vector<std::string>& also_known = {}) {
  if (names_method_table(name)) return {describe_method(integrator_named(name))};
  std::vector<nlohmann::json> found;
  if (text::is_text_file(name))
    return {is_text_bracket(name) ? describe_bracket(bracket_named(name))
                                  : describe_system(system_named(name))};
  if (const auto* system = systems().find(name)) found.push_back(describe_system(*system));
  if (const auto* method = integrators().find(name)) found.push_back(describe_method(*method));
  if (const auto* bracket = brackets().find(name)) found.push_back(describe_bracket(*bracket));
  if (const auto* formulation = formulations().find(name))
    found.push_back(describe_formulation(*formulation));
  const std::vector<std::string> experiments = experiment_names();
  if (std::find(experiments.begin(), experiments.end(), name) != experiments.end())
    found.push_back(describe_experiment(name));
  if (!found.empty()) return found;
  std::vector<std::string> names;
  for (const auto& more : {systems().names(), integrators().names_and_aliases(), brackets().names(),
                           formulations().names(), experiments, also_known})
    for (const std::string& one : more)
      if (std::find(names.begin(), names.end(), one) == names.end()) names.push_back(one);
  throw InputError(unknown_name("name", name, names));
}

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
    for (const char* column : {"name", "initial", "default", "range", "order", "formulation", "expected",
                               "origin", "unit", "title", "steps", "preserves", "meaning"})
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

int cite(const std::vector<std::string>& names, bool json) {
  nlohmann::json j{{"schema", 1}, {"entries", nlohmann::json::array()}};
  std::vector<std::string> keys;
  for (const std::string& name : names) {
    std::vector<std::string> found;
    if (!bibtex(name).empty()) {
      found = {name};
    } else {
      found = keys_of(describe(name, citation_keys()).front());
    }
    for (const std::string& key : found)
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  }
  for (const std::string& key : keys) {
    j["entries"].push_back({{"key", key}, {"citation", citation(key)}, {"bibtex", bibtex(key)}});
    if (!json) std::cout << bibtex(key) << '\n';
  }
  if (json) std::cout << json_text(j);
  return 0;
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
      return 0;
    };
  });
}

void add_cite(CLI::App& app, Common& common, Action& action) {
  CLI::App* sub = subcommand(app, common, "cite", "BibTeX entries behind a plug-in, an experiment or a key");
  auto names = std::make_shared<std::vector<std::string>>();
  sub->add_option("name", *names, "Names, as in pfaff list, or keys of references.bib")
      ->type_name("NAME")
      ->required();
  sub->callback(
      [names, &common, &action] { action = [names, &common] { return cite(*names, common.json); }; });
}

}  // namespace pfaff::app
