// Registries: every plug-in of a kind by name, filled by static objects while libraries are loaded.
//
// Registering never throws: a second plug-in of the same name, and one whose name or parameter cannot be
// written on a command line, is kept aside and reported with its file. An alias, a plug-in under another name
// and with some parameters set, is found by name and not listed.
//
// Whoever reads a registry finds what ships with Pfaff in it: the library of plug-ins is loaded before
// (core/registry/shipped_plugins.hpp).
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/registry/shipped_plugins.hpp>

namespace pfaff {

/// True for kebab-case, as in "damped-pendulum": a small letter, then small letters, digits and single
/// hyphens.
bool is_kebab_case(std::string_view name);

class SystemPlugin;
class MethodPlugin;
class BracketPlugin;
class FormulationPlugin;

/// What was wrong with registrations of one kind, whatever the kind.
class RegistrationFaults {
 public:
  RegistrationFaults();
  RegistrationFaults(const RegistrationFaults&) = delete;
  RegistrationFaults& operator=(const RegistrationFaults&) = delete;
  virtual ~RegistrationFaults();
  /// One line for every name registered twice.
  [[nodiscard]] const std::vector<std::string>& duplicates() const { return duplicates_; }
  /// One line for every plug-in that was not registered because of its name or a parameter's.
  [[nodiscard]] const std::vector<std::string>& misnamed() const { return misnamed_; }

 protected:
  std::vector<std::string> duplicates_, misnamed_;
};

/// Whether the library of plug-ins has some of this kind.
template <class P>
constexpr bool shipped_apart = std::is_same_v<P, SystemPlugin> || std::is_same_v<P, MethodPlugin>;

/// All plug-ins of one kind.
template <class P>
class Registry final : public RegistrationFaults {
 public:
  /// Adds a plug-in with static lifetime.
  void add(const P* plugin) {
    if constexpr (requires { plugin->parameters(); }) {
      std::vector<std::string> taken;
      for (const auto& parameter : plugin->parameters()) {
        if (!is_kebab_case(parameter.name)) return refuse(*plugin, "parameter", parameter.name);
        if (std::find(taken.begin(), taken.end(), parameter.name) != taken.end())
          return refuse(*plugin, "parameter", parameter.name, "names that differ");
        taken.push_back(parameter.name);
      }
    }
    insert(plugin, plugins_, aliases_);
  }
  /// Adds another name for a plug-in, itself of the plug-in's kind: it is found by its name and not listed.
  void add_alias(const P* alias) { insert(alias, aliases_, plugins_); }

  /// Plug-ins in alphabetical order, without aliases.
  [[nodiscard]] const std::vector<const P*>& all() const {
    complete();
    return plugins_;
  }
  /// Aliases in alphabetical order.
  [[nodiscard]] const std::vector<const P*>& aliases() const {
    complete();
    return aliases_;
  }

  /// The plug-in or alias of that name; null where there is none.
  [[nodiscard]] const P* find(std::string_view name) const {
    complete();
    for (const auto* list : {&plugins_, &aliases_})
      if (const auto place = place_of(name, *list); has(name, *list, place)) return *place;
    return nullptr;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const P* plugin : all()) result.push_back(plugin->name());
    return result;
  }
  /// The names of plug-ins and, after them, of aliases.
  [[nodiscard]] std::vector<std::string> names_and_aliases() const {
    std::vector<std::string> result = names();
    for (const P* alias : aliases()) result.push_back(alias->name());
    return result;
  }
  /// The plug-in of that name; InputError with the nearest name otherwise. `kind` is "system", "integrator"…
  const P& get(std::string_view name, std::string_view kind) const {
    if (const P* plugin = find(name)) return *plugin;
    // An alias may be the nearest name; the list of what there is does without them.
    const std::string near = nearest(name, names_and_aliases());
    throw InputError(unknown_name(kind, name, near.empty() ? names() : names_and_aliases()) +
                     (shipped_apart<P> ? what_is_left_out() : ""));
  }

 private:
  using List = std::vector<const P*>;

  static void complete() {
    if constexpr (shipped_apart<P>) load_shipped_plugins();
  }
  static typename List::const_iterator place_of(std::string_view name, const List& list) {
    return std::lower_bound(list.begin(), list.end(), name,
                            [](const P* plugin, std::string_view key) { return plugin->name() < key; });
  }
  static bool has(std::string_view name, const List& list, typename List::const_iterator place) {
    return place != list.end() && (*place)->name() == name;
  }
  void insert(const P* plugin, List& list, List& other) {
    const std::string& name = plugin->name();
    if (!is_kebab_case(name)) return refuse(*plugin, "name", name);
    for (List* taken : {&list, &other})
      if (const auto place = place_of(name, *taken); has(name, *taken, place)) {
        const bool displaces = shipped_plugins_register();
        const P &kept = displaces ? *plugin : **place, &duplicate = displaces ? **place : *plugin;
        duplicates_.push_back(name + " in " + kept.file() + " and " + duplicate.file());
        if (!displaces) return;
        taken->erase(place);
      }
    list.insert(place_of(name, list), plugin);
  }

  void refuse(const P& plugin, std::string_view what, const std::string& text,
              std::string_view expected = "kebab-case, such as 'damped-pendulum'") {
    misnamed_.push_back(plugin.name() + " in " + plugin.file() + ": the " + std::string(what) + " '" + text +
                        "'; expected " + std::string(expected));
  }

  List plugins_, aliases_;
};

/// The registries, one of each kind in the process.
Registry<SystemPlugin>& systems();
Registry<MethodPlugin>& integrators();
Registry<BracketPlugin>& brackets();
Registry<FormulationPlugin>& formulations();

// Compiled once, in core/registries.cpp, and not in the file of every plug-in.
extern template class Registry<SystemPlugin>;
extern template class Registry<MethodPlugin>;
extern template class Registry<BracketPlugin>;
extern template class Registry<FormulationPlugin>;

/// One line for every name of any kind that is registered twice.
std::vector<std::string> registered_twice();

/// One line for every plug-in of any kind that was not registered because of its name or a parameter's.
std::vector<std::string> misnamed();

/// Loads a plug-in's shared object and with it its registrations. InputError, before anything of it is
/// loaded, for a file that is no whole shared object or whose ABI stamp is missing or different; then, from a
/// process of its own in which it is loaded first, for a file whose initialisers throw or end the process;
/// and afterwards for names that are registered twice or are not kebab-case.
void load_plugin(const std::string& path);

}  // namespace pfaff
