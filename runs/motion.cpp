#include <pfaff/runs/motion.hpp>

#include <pfaff/runs/asked_for.hpp>

namespace pfaff {

namespace {
const FormulationPlugin& formulation_of_kind(bool of_velocities) {
  return of_velocities ? nonholonomic_formulation() : dirac_formulation();
}
}  // namespace

const FormulationPlugin& dirac_formulation() { return formulations().get("dirac", "formulation"); }

const FormulationPlugin& nonholonomic_formulation() {
  return formulations().get("nonholonomic", "formulation");
}

const FormulationPlugin& default_formulation(const Model& model) {
  return formulation_of_kind(model.nonholonomic());
}

namespace {
// The formulation of that name; null for an empty one. It is refused where there are no constraints.
const FormulationPlugin* named_formulation(const std::string& name, const std::string& system,
                                           bool constrained) {
  if (name.empty()) return nullptr;
  const FormulationPlugin& named = formulations().get(spelled(name), "formulation");
  if (!constrained) throw InputError("--formulation: " + system + " has no constraints; expected none");
  return &named;
}
}  // namespace

const FormulationPlugin* formulation_for(const SystemPlugin& system, const std::string& name) {
  const FormulationPlugin* named = named_formulation(name, system.name(), system.constrained());
  if (named != nullptr || !system.constrained()) return named;
  return &formulation_of_kind(system.constrains_velocities());
}

AskedFormulation formulation_asked_for(const Model& model, const std::string& text) {
  if (text.empty()) return {model.restricted() && !model.moves() ? &default_formulation(model) : nullptr, {}};
  PluginValue asked = parse_plugin_value(text, "formulation");
  return {named_formulation(asked.name, model.name(), model.restricted()), std::move(asked.settings)};
}

std::shared_ptr<const Model> motion_of(const std::shared_ptr<const Model>& model) {
  return model->moves() || !model->restricted() ? model : default_formulation(*model).apply(model, {});
}

std::shared_ptr<const Model> solved_model(const std::shared_ptr<const Model>& model) {
  return model->facets().has(Facet::exact_solution) ? model : motion_of(model);
}

std::shared_ptr<const Model> motion_for(const MethodInstance& method,
                                        const std::shared_ptr<const Model>& model) {
  return method.refuses(*model).empty() ? model : motion_of(model);
}

}  // namespace pfaff
