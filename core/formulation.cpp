#include <pfaff/core/formulation.hpp>

#include <algorithm>

namespace pfaff {

namespace {
// The names of the formulations that need velocity constraints, "a or b or c".
std::string formulations_of_velocities() {
  std::string names;
  for (const FormulationPlugin* plugin : formulations().all())
    if (plugin->needs().has(Facet::velocity_constraints))
      names += (names.empty() ? "" : " or ") + plugin->name();
  return names;
}
}  // namespace

std::string FormulationPlugin::misfit(const Model& model) const {
  const std::string subject = "formulation " + name(),
                    offers = model.name() + " offers " + to_string(model.facets());
  if (!model.restricted() || !model.source().formulation.empty())
    return subject + " needs a system with constraints; " + offers;
  if (model.nonholonomic() && !needs().has(Facet::velocity_constraints))
    return subject + " makes no motion of velocity constraints, which " + model.name() + " has; expected " +
           formulations_of_velocities();
  if (!model.facets().includes(needs())) return subject + " needs " + to_string(needs()) + "; " + offers;
  return {};
}

ModelSource motion_of_energy(const Model& model, Tape hamiltonian) {
  const ModelSource& whole = model.source();
  const auto energy = std::make_shared<const Tape>(std::move(hamiltonian));
  ModelSource source;
  source.name = whole.name;
  source.dimension = whole.dimension;
  source.canonical = true;
  source.coordinates = whole.coordinates;
  source.initial = whole.initial;
  source.time_unit = whole.time_unit;
  source.parameters = whole.parameters;
  source.given[index(Formula::hamiltonian)] = energy;
  if (energy->autonomous()) {
    const auto named = std::find_if(whole.invariants.begin(), whole.invariants.end(),
                                    [](const Invariant& i) { return i.name == "energy"; });
    source.invariants = {conserved("energy", named == whole.invariants.end() ? "" : named->unit)};
    source.given[index(Formula::invariants)] = energy;
  }
  return source;
}

}  // namespace pfaff
