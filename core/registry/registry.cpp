#include <pfaff/core/registry/registry.hpp>

#include <dlfcn.h>

#include <fstream>
#include <iterator>

#include <pfaff/core/bracket.hpp>
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

void load_plugin(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError("plug-in '" + path + "': cannot be read");
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto mark = bytes.find(PFAFF_ABI_MARK);
  if (mark == std::string::npos)
    throw InputError("plug-in '" + path + "': has no Pfaff ABI stamp; expected a shared object built against Pfaff");
  const auto begin = mark + std::string_view(PFAFF_ABI_MARK).size();
  const std::string stamp(bytes, begin, bytes.find('\0', begin) - begin);
  if (stamp != PFAFF_ABI_STAMP)
    throw InputError("plug-in '" + path + "': built for [" + stamp + "], expected [" PFAFF_ABI_STAMP "]");
  const std::string local = path.find('/') == std::string::npos ? "./" + path : path;
  if (dlopen(local.c_str(), RTLD_NOW | RTLD_LOCAL) == nullptr)
    throw InputError("plug-in '" + path + "': " + dlerror());
  std::string twice;
  for (const auto* names : {&systems().duplicates(), &integrators().duplicates(), &brackets().duplicates()})
    for (const std::string& name : *names) twice += (twice.empty() ? "" : "; ") + name;
  if (!twice.empty()) throw InputError("registered twice: " + twice);
}

}  // namespace pfaff
