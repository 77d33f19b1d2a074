#include <pfaff/core/registry/registry.hpp>

#include <dlfcn.h>

#include <cfenv>

#include <pfaff/core/bracket.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/integrator.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff {

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

void load_plugin(const std::string& path) {
  require_same_abi(path);
  const std::string local = path.find('/') == std::string::npos ? "./" + path : path;
  // Whatever the file's start-up code does to the rounding and the treatment of subnormals is undone.
  std::fenv_t arithmetic;
  std::fegetenv(&arithmetic);
  const void* handle = dlopen(local.c_str(), RTLD_NOW | RTLD_LOCAL);
  std::fesetenv(&arithmetic);
  if (handle == nullptr) throw InputError("plug-in '" + path + "': " + dlerror());
  std::string twice;
  for (const auto* names : {&systems().duplicates(), &integrators().duplicates(), &brackets().duplicates(),
                            &formulations().duplicates()})
    for (const std::string& name : *names) twice += (twice.empty() ? "" : "; ") + name;
  if (!twice.empty()) throw InputError("registered twice: " + twice);
}

}  // namespace pfaff
