// The kinds of plug-ins, each with its registry: the one place that says which there are.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/bracket.hpp>
#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>
#include <pfaff/runs/measure.hpp>

namespace pfaff {

/// Calls with(one, several, registry) for each kind, as with("system", "systems", systems()). The plural is
/// also the name of the folder in which plug-ins of the kind stand.
template <class With>
void for_each_kind(const With& with) {
  with("system", "systems", systems());
  with("integrator", "integrators", integrators());
  with("bracket", "brackets", brackets());
  with("formulation", "formulations", formulations());
  with("measure", "measures", measures());
}

/// "systems", "integrators" and so on.
inline std::vector<std::string> names_of_kinds() {
  std::vector<std::string> names;
  for_each_kind([&](const char*, const char* several, const auto&) { names.emplace_back(several); });
  return names;
}

/// The same with commas between.
inline std::string kinds_in_words() {
  std::string words;
  for (const std::string& kind : names_of_kinds()) words += (words.empty() ? "" : ", ") + kind;
  return words;
}

/// The names of all plug-ins, with aliases.
inline std::vector<std::string> names_of_plugins() {
  std::vector<std::string> names;
  for_each_kind([&](const char*, const char*, const auto& registry) {
    const std::vector<std::string> more = registry.names_and_aliases();
    names.insert(names.end(), more.begin(), more.end());
  });
  return names;
}

}  // namespace pfaff
