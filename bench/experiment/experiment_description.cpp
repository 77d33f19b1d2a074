#include <pfaff/bench/experiment/experiment_description.hpp>

#include <algorithm>

#include <pfaff/bench/experiment/automatic_steps.hpp>
#include <pfaff/bench/experiment/citations.hpp>
#include <pfaff/bench/experiment/tables.hpp>
#include <pfaff/core/tape/kinks.hpp>

namespace pfaff {

nlohmann::json description(const Experiment& experiment, const std::vector<ExperimentRun>& runs,
                           const std::vector<LeftOut>& left_out) {
  nlohmann::json j{{"schema", schema_of_runs},          {"name", experiment.name},
                   {"title", experiment.title},         {"description", experiment.description},
                   {"reference", experiment.reference}, {"notes", experiment.notes},
                   {"quick", experiment.quick},         {"versions", versions()},
                   {"asked_for", experiment.asked_for}};
  if (experiment.compile) j["compile"] = true;
  for (const LeftOut& one : left_out)
    j["left_out"].push_back({{"case", one.of_case}, {"method", one.method}, {"reason", one.reason}});
  for (const DriftClassEntry& entry : drift_classes())
    j["drift_classes"].push_back({{"name", entry.name},
                                  {"meaning", entry.meaning},
                                  {"measure", entry.measure},
                                  {"grows", entry.grows},
                                  {"keeps", entry.keeps}});
  describe_tables(experiment, runs, j);
  j["citation"] = nlohmann::json::array();
  for (const std::string& key : experiment.reference) j["citation"].push_back(citation(key));
  for (const ExperimentCase& c : experiment.cases) {
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.which == &c; });
    const Model& model = *run->resolved.model;
    nlohmann::json parameters = nlohmann::json::object();
    for (const auto& [key, value] : model.parameters()) parameters[key] = value;
    nlohmann::json structure;  // null where there is none to keep
    if (const auto name = structure_name(model); !name.empty()) structure = name;
    const bool exact = model.facets().has(Facet::exact_solution);
    j["cases"].push_back({{"name", c.name},
                          {"title", c.title},
                          {"system", c.system},
                          {"parameters", parameters},
                          {"time", to_string(run->resolved.time)},
                          {"time_unit", model.time_unit()},
                          {"precision", to_string(c.precision)},
                          {"conserved", c.conserved},
                          {"motion", c.motion},
                          {"structure", structure},
                          {"reference_solution", !c.reference ? "none"
                                                 : exact      ? "exact"
                                                              : "30-digit"}});
    if (const std::string name = system_name(*run); name != c.system) j["cases"].back()["model"] = name;
    if (const auto field = model.tape(Formula::field); field != nullptr && !Kinks<double>(*field).none())
      j["cases"].back()["kinks"] = true;
    if (!c.error.empty()) j["cases"].back()["error"] = c.error;
    // Steps that are still to be chosen may make more rows than these.
    const bool many = c.automatic || std::any_of(runs.begin(), runs.end(), [&](const ExperimentRun& r) {
                        return r.which == &c && r.resolved.rows() > most_error_rows;
                      });
    if (many && c.reference && !c.errors_at_every_row) j["cases"].back()["error_rows"] = most_error_rows;
    for (const auto& [key, value] : {std::pair("equation", c.asked.equation),
                                     {"question", c.asked.question},
                                     {"answer", c.asked.answer}})
      if (!value.empty()) j["cases"].back()[key] = value;
    for (const auto& [key, value] : c.frequencies) j["cases"].back()["frequencies"][key] = value;
    if (c.seeds > 0) j["cases"].back()["seeds"] = c.seeds;
    if (c.automatic) {
      j["cases"].back()["steps"] = "auto";
      j["cases"].back()["evaluations"] = c.evaluations.value_or(default_evaluations);
    }
  }
  for (const ExperimentMethod& m : experiment.methods) {
    const auto run =
        std::find_if(runs.begin(), runs.end(), [&](const ExperimentRun& r) { return r.method == &m; });
    if (run == runs.end()) continue;
    nlohmann::json parameters = nlohmann::json::object(), systems = nlohmann::json::array();
    for (const auto& [key, value] : run->resolved.method->parameters()) parameters[key] = value;
    // The order and claims of a method on each system, as `describe` gives them; they are listed per system
    // because they may depend on the problem.
    std::vector<std::string> seen;
    for (const ExperimentRun& r : runs) {
      if (r.method != &m || std::find(seen.begin(), seen.end(), r.which->system) != seen.end()) continue;
      seen.push_back(r.which->system);
      nlohmann::json claims = nlohmann::json::array();
      const Model& model = *r.resolved.model;
      for (const Claim claim : claims_in_scope(r.resolved.method->preserves(model), model))
        claims.push_back(to_string(claim));
      systems.push_back({{"name", r.which->system},
                         {"order", r.resolved.method->order(*r.resolved.model)},
                         {"preserves", claims}});
    }
    j["methods"].push_back({{"label", m.label},
                            {"integrator", m.integrator},
                            {"family", run->resolved.method->family()},
                            {"parameters", parameters},
                            {"systems", systems}});
    if (makes_another_motion(*run->resolved.model)) j["methods"].back()["another_motion"] = true;
    if (!m.tolerances.empty()) j["methods"].back()["tolerances"] = m.tolerances;
    if (!m.absolute.empty()) j["methods"].back()["absolute"] = m.absolute;
    if (!run->resolved.settings.formulation.empty()) {
      j["methods"].back()["formulation"] = run->resolved.settings.formulation;
      for (const auto& [key, value] : run->resolved.model->source().formulation_parameters)
        j["methods"].back()["parameters"]["formulation." + key] = value;
    }
  }
  return j;
}

}  // namespace pfaff
