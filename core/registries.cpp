// The registries of the four kinds of plug-ins.
#include <pfaff/core/bracket.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

template class Registry<SystemPlugin>;
template class Registry<MethodPlugin>;
template class Registry<BracketPlugin>;
template class Registry<FormulationPlugin>;

Registry<SystemPlugin>& systems() {
  static Registry<SystemPlugin> registry;
  return registry;
}
Registry<MethodPlugin>& integrators() {
  static Registry<MethodPlugin> registry;
  return registry;
}
Registry<BracketPlugin>& brackets() {
  static Registry<BracketPlugin> registry;
  return registry;
}
Registry<FormulationPlugin>& formulations() {
  static Registry<FormulationPlugin> registry;
  return registry;
}

}  // namespace pfaff
