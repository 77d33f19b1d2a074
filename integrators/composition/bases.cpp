#include <pfaff/integrators/composition/bases.hpp>

#include <algorithm>

namespace pfaff {

namespace {
bool symmetric(const MethodPlugin& method) {
  const std::vector<Claim>& kept = method.descriptor().preserves;
  return std::find(kept.begin(), kept.end(), Claim::symmetric) != kept.end();
}

// The reason alone.
std::string why_unfit(const MethodPlugin& plugin, const MethodInstance& method) {
  if (method.adaptive()) return "it chooses its steps itself";
  const bool composable = method.composed({Quad(1)}, 0) != nullptr;
  if (!symmetric(plugin) && (composable || !plugin.descriptor().preserves.empty()))
    return "it is not symmetric";
  if (!composable) return "it does not say how it is composed";
  return plugin.descriptor().order == 2 ? "" : "its order is not 2";
}
}  // namespace

std::vector<std::string> base_names() {
  std::vector<std::string> names;
  for (const MethodPlugin* method : integrators().all())
    if (why_unfit(*method, *method->make({})).empty()) names.push_back(method->name());
  return names;
}

std::string unfit_as_base(const MethodPlugin& plugin, const MethodInstance& method) {
  std::string reason = why_unfit(plugin, method);
  if (reason.empty()) return reason;
  std::string list;
  for (const std::string& name : base_names()) list += (list.empty() ? "" : ", ") + name;
  return reason + "; expected one of: " + list;
}

}  // namespace pfaff
