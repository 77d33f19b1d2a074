#include <pfaff/bench/runner/motion.hpp>

namespace pfaff {

const FormulationPlugin& dirac_formulation() { return formulations().get("dirac", "formulation"); }

const FormulationPlugin* formulation_for(const SystemPlugin& system, const std::string& name) {
  const FormulationPlugin* named = name.empty() ? nullptr : &formulations().get(name, "formulation");
  if (system.constrained()) return named != nullptr ? named : &dirac_formulation();
  if (named != nullptr)
    throw InputError("--formulation: " + system.name() + " has no constraints; expected none");
  return nullptr;
}

std::shared_ptr<const Model> motion_of(const std::shared_ptr<const Model>& model) {
  return model->moves() || !model->restricted() ? model : dirac_formulation().apply(model, {});
}

std::shared_ptr<const Model> motion_for(const MethodInstance& method,
                                        const std::shared_ptr<const Model>& model) {
  return method.refuses(*model).empty() ? model : motion_of(model);
}

}  // namespace pfaff
