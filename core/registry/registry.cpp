#include <pfaff/core/registry/registry.hpp>

#include <dlfcn.h>

#include <algorithm>

#include <pfaff/core/process/shared_object.hpp>
#include <pfaff/core/registry/abi.hpp>
#include <pfaff/core/registry/trial_load.hpp>

namespace pfaff {

bool is_kebab_case(std::string_view name) {
  const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
  return !name.empty() && small(name.front()) && name.back() != '-' &&
         name.find("--") == std::string_view::npos && std::all_of(name.begin(), name.end(), [&](char c) {
           return small(c) || (c >= '0' && c <= '9') || c == '-';
         });
}

std::vector<std::string> registered_twice() {
  std::vector<std::string> all;
  for (const auto* names : {&systems().duplicates(), &integrators().duplicates(), &brackets().duplicates(),
                            &formulations().duplicates()})
    all.insert(all.end(), names->begin(), names->end());
  return all;
}

std::vector<std::string> misnamed() {
  std::vector<std::string> all;
  for (const auto* names :
       {&systems().misnamed(), &integrators().misnamed(), &brackets().misnamed(), &formulations().misnamed()})
    all.insert(all.end(), names->begin(), names->end());
  return all;
}

void load_plugin(const std::string& path) {
  require_same_abi(path);
  const std::string local = path.find('/') == std::string::npos ? "./" + path : path;
  if (const std::string reason = trial_load(local); !reason.empty())
    throw InputError("plug-in '" + path + "': " + reason);
  if (load_shared_object(local, "plug-in '" + path + "'") == nullptr)
    throw InputError("plug-in '" + path + "': " + dlerror());
  std::string twice;
  for (const std::string& name : registered_twice()) twice += (twice.empty() ? "" : "; ") + name;
  if (!twice.empty()) throw InputError("registered twice: " + twice);
  if (const auto names = misnamed(); !names.empty())
    throw InputError("plug-in '" + path + "': " + names.front());
}

}  // namespace pfaff
