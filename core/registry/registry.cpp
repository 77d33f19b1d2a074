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

namespace {
// The faults of every registry of the process.
std::vector<const RegistrationFaults*>& of_all_kinds() {
  static std::vector<const RegistrationFaults*> all;
  return all;
}
std::vector<std::string> lines(const std::vector<std::string>& (RegistrationFaults::*of_a_kind)() const) {
  load_shipped_plugins();
  std::vector<std::string> all;
  for (const RegistrationFaults* faults : of_all_kinds())
    all.insert(all.end(), (faults->*of_a_kind)().begin(), (faults->*of_a_kind)().end());
  return all;
}
}  // namespace

RegistrationFaults::RegistrationFaults() { of_all_kinds().push_back(this); }
RegistrationFaults::~RegistrationFaults() { std::erase(of_all_kinds(), this); }

std::vector<std::string> registered_twice() { return lines(&RegistrationFaults::duplicates); }
std::vector<std::string> misnamed() { return lines(&RegistrationFaults::misnamed); }

void load_plugin(const std::string& path) {
  require_same_abi(path);
  load_shipped_plugins();
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
