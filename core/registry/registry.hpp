// Registries: every plug-in of a kind by name, filled by static objects while libraries are loaded.
//
// Registering never throws: a second plug-in of the same name is kept aside and reported with both files.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <pfaff/core/registry/errors.hpp>

namespace pfaff {

class SystemPlugin;
class MethodPlugin;
class BracketPlugin;
class FormulationPlugin;

/// All plug-ins of one kind.
template <class P>
class Registry {
 public:
  /// Adds a plug-in with static lifetime.
  void add(const P* plugin) {
    const auto [place, taken] = find_place(plugin->name());
    if (taken) {
      duplicates_.push_back(plugin->name() + " in " + (*place)->file() + " and " + plugin->file());
    } else {
      plugins_.insert(place, plugin);
    }
  }

  /// Plug-ins in alphabetical order.
  [[nodiscard]] const std::vector<const P*>& all() const { return plugins_; }
  /// One line for every name registered twice.
  [[nodiscard]] const std::vector<std::string>& duplicates() const { return duplicates_; }

  [[nodiscard]] const P* find(std::string_view name) const {
    for (const P* plugin : plugins_)
      if (plugin->name() == name) return plugin;
    return nullptr;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const P* plugin : plugins_) result.push_back(plugin->name());
    return result;
  }
  /// The plug-in of that name; InputError with the nearest name otherwise. `kind` is "system", "integrator"…
  const P& get(std::string_view name, std::string_view kind) const {
    if (const P* plugin = find(name)) return *plugin;
    throw InputError(unknown_name(kind, name, names()));
  }

 private:
  std::pair<typename std::vector<const P*>::iterator, bool> find_place(const std::string& name) {
    auto place =
        std::lower_bound(plugins_.begin(), plugins_.end(), name,
                         [](const P* plugin, const std::string& key) { return plugin->name() < key; });
    return {place, place != plugins_.end() && (*place)->name() == name};
  }

  std::vector<const P*> plugins_;
  std::vector<std::string> duplicates_;
};

/// The registries, one of each kind in the process.
Registry<SystemPlugin>& systems();
Registry<MethodPlugin>& integrators();
Registry<BracketPlugin>& brackets();
Registry<FormulationPlugin>& formulations();

/// Loads a plug-in's shared object and with it its registrations. Refuses, before loading, a file whose ABI
/// stamp is missing or different (InputError).
void load_plugin(const std::string& path);

}  // namespace pfaff
