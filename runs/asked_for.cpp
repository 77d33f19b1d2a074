#include <pfaff/runs/asked_for.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

#include <pfaff/core/bracket.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/integrators/tables/method_table.hpp>
#include <pfaff/runs/measure.hpp>
#include <pfaff/systems/text/text_system.hpp>

namespace pfaff {

Real finite_number(const std::string& text, const std::string& what) {
  const auto value = Real::parse(text);
  if (!value || !std::isfinite(value->value()))
    throw InputError(what + ": expected a finite decimal number or a/b, got '" + text + "'");
  return *value;
}

std::string in_small_letters(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

std::string spelled(const std::string& name) {
  const std::string small = in_small_letters(name);
  const bool registered = systems().find(small) != nullptr || integrators().find(small) != nullptr ||
                          brackets().find(small) != nullptr || formulations().find(small) != nullptr ||
                          measures().find(small) != nullptr;
  return registered ? small : name;
}

namespace {
// InputError, which says so, where a name of one kind is that of another.
template <class P, class Other>
std::string of_its_kind(const Registry<P>& registry, const Registry<Other>& others, const std::string& name,
                        const char* kind, const char* other) {
  std::string found = spelled(name);
  if (registry.find(found) == nullptr && others.find(found) != nullptr)
    throw InputError("'" + name + "' is " + other + "; expected " + kind);
  return found;
}

// The integrators that can step on a model, made with their defaults.
std::vector<std::pair<const MethodPlugin*, std::unique_ptr<MethodInstance>>> methods_that_fit(
    const Model& model) {
  std::vector<std::pair<const MethodPlugin*, std::unique_ptr<MethodInstance>>> fitting;
  for (const MethodPlugin* method : integrators().all())
    if (auto made = method->make({}); made->refuses(model).empty())
      fitting.emplace_back(method, std::move(made));
  return fitting;
}
}  // namespace

const SystemPlugin& system_asked_for(const std::string& name) {
  return system_named(of_its_kind(systems(), integrators(), name, "a system", "an integrator"));
}
const MethodPlugin& integrator_asked_for(const std::string& name) {
  return integrator_named(of_its_kind(integrators(), systems(), name, "an integrator", "a system"));
}

std::string what_to_do(const MethodInstance& method, const Model& model) {
  std::string text;
  if (method.needs().has(Facet::separable) && model.facets().has(Facet::hamiltonian))
    text = "; kinetic and potential energies that are written apart make a system separable";
  if (const MethodPlugin* plugin = integrators().find(method.descriptor().name))
    for (const Parameter& parameter : plugin->parameters())
      if (parameter.kind == Parameter::Kind::plugin)
        text += "; its parameter '" + parameter.name + "' takes other methods";
  constexpr std::size_t most = 6;
  // Those that keep most of what the system has come first.
  std::vector<std::pair<std::size_t, std::string>> fitting;
  for (const auto& [other, made] : methods_that_fit(model))
    fitting.emplace_back(claims_in_scope(made->preserves(model), model).size(), other->name());
  std::stable_sort(fitting.begin(), fitting.end(),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  if (fitting.empty()) return text;
  text += "; methods that fit: ";
  for (std::size_t k = 0; k < std::min(most, fitting.size()); ++k)
    text += (k == 0 ? "" : ", ") + fitting[k].second;
  return text + (fitting.size() > most ? ", ... (pfaff describe " + model.name() + ")" : "");
}

std::string or_methods_that_choose(const Model& model) {
  std::string names;
  for (const auto& [method, made] : methods_that_fit(model))
    if (made->adaptive()) names += (names.empty() ? ", or one of " : ", ") + method->name();
  return names;
}

}  // namespace pfaff
