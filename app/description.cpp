#include <pfaff/app/description.hpp>

#include <algorithm>

#include <pfaff/bench/experiment/automatic_steps.hpp>
#include <pfaff/bench/experiment/experiment.hpp>
#include <pfaff/bench/runner/terminal.hpp>
#include <pfaff/core/facets/derivations/derivation.hpp>
#include <pfaff/core/facets/stated_ranges.hpp>
#include <pfaff/core/registry/range_text.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/asked_for.hpp>
#include <pfaff/runs/kinds.hpp>
#include <pfaff/runs/motion.hpp>
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

// The formulations that fit a system with constraints.
nlohmann::json formulations_of(const std::shared_ptr<const Model>& model) {
  nlohmann::json names = nlohmann::json::array();
  for (const FormulationPlugin* formulation : formulations().all())
    if (formulation->refuses(*model).empty()) names.push_back(formulation->name());
  return names;
}

// What the literature and the documentation write for a formula.
std::string symbol_of(Formula formula) {
  using enum Formula;
  switch (formula) {  // without a default, so that the compiler names a formula that is left out
    case field:
      return "X, dz/dt = X(z, t)";
    case field_jacobian:
      return "dX/dz";
    case hamiltonian:
      return "H";
    case hamiltonian_gradient:
      return "grad H";
    case poisson_tensor:
      return "Pi, X = Pi grad H";
    case casimirs:
      return "C, Pi grad C = 0";
    case kinetic:
      return "T, H = T + V";
    case potential:
      return "V, H = T + V";
    case force:
      return "-dV/dq";
    case velocity:
      return "dT/dp";
    case birkhoffian:
      return "B of F.dz - B dt";
    case one_form:
      return "F of F.dz - B dt";
    case structure:
      return "K of K z' + D = 0";
    case covector:
      return "D of K z' + D = 0";
    case chart:
      return "y(z, t)";
    case chart_inverse:
      return "z(y, t)";
    case chart_hamiltonian:
      return "H(y, t)";
    case chart_field:
      return "Y, dy/dt = Y(y, t)";
    case chart_field_jacobian:
      return "dY/dy";
    case alpha:
      return "w^ and w";
    case holonomic:
      return "phi(q, t) = 0";
    case friction:
      return "lambda, of each momentum";
    case applied_force:
      return "Q, p' = -H_q + Q";
    case constraints:
      return "phi(z, t) = 0";
    case constraint_gradients:
      return "dphi/dz";
    case velocity_constraints:
      return "A of A v + b = 0";
    case velocity_offsets:
      return "b of A v + b = 0";
    case symmetric_tensor:
      return "G, symmetric";
    case entropy:
      return "S";
    case invariants:
      return "I";
    case exact_solution:
      return "z(t)";
    case reversal:
      return "rho";
    case count:
      break;
  }
  return {};
}

// The formulas that make what a model offers, and all that its author wrote: for each whether it is written,
// and if not, what it is derived from.
nlohmann::json formulas_of(const Model& model) {
  nlohmann::json list = nlohmann::json::array();
  for (const FormulaRow& row : formula_table) {
    nlohmann::json j{{"name", row.name}, {"symbol", symbol_of(row.formula)}};
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

nlohmann::json described(const SystemPlugin& plugin) {
  const auto model = plugin.make({});
  nlohmann::json j{{"dimension", model->dimension()},
                   {"time_unit", model->time_unit()},
                   {"facets", to_string(model->facets())},
                   {"autonomous", model->autonomous()},
                   {"parameters", parameters_of(plugin, model->parameters())},
                   {"formulas", formulas_of(*model)}};
  const std::vector<Range> ranges = stated_ranges(model->coordinates());
  for (std::size_t k = 0; k < model->coordinates().size(); ++k) {
    const Coordinate& c = model->coordinates()[k];
    j["coordinates"].push_back(
        {{"name", c.name},
         {"unit", c.unit},
         {"initial", k < model->initial().size() ? nlohmann::json(to_string(model->initial()[k]))
                                                 : nlohmann::json(nullptr)}});
    // A range is shown with its unit; where others state one, the unit alone stands in its place.
    if (!ranges.empty())
      j["coordinates"].back()["range"] = ranges[k] == unbounded ? c.unit : range_text(ranges[k], c.unit);
  }
  j["invariants"] = nlohmann::json::array();
  for (const Invariant& i : model->invariants())
    j["invariants"].push_back({{"name", i.name}, {"unit", i.unit}, {"expected", to_string(i.behaviour)}});
  if (!model->part_names().empty()) {
    j["parts"] = model->part_names();
    if (const auto small = model->small_part()) j["small_part"] = model->part_names()[*small];
  }
  if (model->restricted()) {
    j["constraints"] = model->constraint_names();
    j["formulations"] = formulations_of(model);
  }
  add_methods(j, model);
  return j;
}

nlohmann::json described(const MethodPlugin& plugin) {
  const auto method = plugin.make({});
  nlohmann::json j{{"needs", to_string(method->needs())},
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

nlohmann::json described(const BracketPlugin& plugin) {
  const BracketInstance bracket = plugin.make({});
  return {{"dimension", bracket.dimension},
          {"symmetry", to_string(plugin.descriptor().symmetry)},
          {"jacobi", plugin.descriptor().jacobi},
          {"parameters", parameters_of(plugin, bracket.parameters)}};
}

nlohmann::json described(const FormulationPlugin& plugin) {
  nlohmann::json j{{"parameters", parameters_of(plugin, plugin.resolve({}))}};
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

nlohmann::json described(const MeasurePlugin& plugin) {
  const auto measure = plugin.make({});
  const MeasureDescriptor& d = plugin.descriptor();
  nlohmann::json j{{"over", d.over == Over::time ? "time" : "step"},
                   {"usual", d.usual},
                   {"parameters", parameters_of(plugin, measure->parameters())},
                   {"watches", nlohmann::json::array()}};
  for (const Claim claim : d.watches) j["watches"].push_back(to_string(claim));
  return j;
}

// A plug-in, with what all kinds have.
template <class P>
nlohmann::json describe_plugin(const char* kind, const P& plugin) {
  nlohmann::json j = described(plugin);
  const auto& d = plugin.descriptor();
  j.update({{"kind", kind},
            {"name", plugin.name()},
            {"title", d.title},
            {"reference", d.reference},
            {"description", d.description}});
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

}  // namespace

std::vector<nlohmann::json> describe(const std::string& asked, const std::vector<std::string>& also_known) {
  const std::string name = spelled(asked);
  if (names_method_table(name)) return {describe_plugin("integrator", integrator_named(name))};
  std::vector<nlohmann::json> found;
  if (text::is_text_file(name))
    return {is_text_bracket(name) ? describe_plugin("bracket", bracket_named(name))
                                  : describe_plugin("system", system_named(name))};
  for_each_kind([&](const char* kind, const char*, const auto& registry) {
    if (const auto* plugin = registry.find(name)) found.push_back(describe_plugin(kind, *plugin));
  });
  const std::vector<std::string> experiments = experiment_names();
  if (std::find(experiments.begin(), experiments.end(), name) != experiments.end())
    found.push_back(describe_experiment(name));
  if (!found.empty()) return found;
  std::vector<std::string> names;
  for (const auto& more : {names_of_plugins(), experiments, also_known})
    for (const std::string& one : more)
      if (std::find(names.begin(), names.end(), one) == names.end()) names.push_back(one);
  throw InputError(unknown_name("name", name, names) + what_is_left_out());
}

}  // namespace pfaff::app
