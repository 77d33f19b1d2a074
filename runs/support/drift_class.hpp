// This is the only list of the classes. Runs write their names (summary.json, results.csv), experiments write
// the list itself (experiment.json, `drift_classes`), from which the report reads it, and a test compares
// docs/drift-and-cost.md with it. drift_rules.hpp says what makes the classifier choose a class.
#pragma once

#include <string_view>
#include <vector>

namespace pfaff {

enum class DriftClass {
  exact,
  round_off,
  biased_round_off,
  bounded,
  random_walk,
  linear,
  polynomial,
  exponential,
  undetermined
};

/// What is said about a class.
struct DriftClassEntry {
  DriftClass drift_class;
  std::string_view name;     // kebab-case, as in every file
  std::string_view meaning;  // what such an error does: a phrase for the report, without a full stop
  std::string_view measure;  // the drift number that says how much: max, slope or exponent; empty for none
  bool grows;                // true where such an error is larger at the end of a longer run
  bool keeps;                // true where it is known not to be: of what is undetermined neither is known
};

/// Every class, from the one that keeps a quantity best to the one that loses it fastest; undetermined comes
/// last.
const std::vector<DriftClassEntry>& drift_classes();

/// What is said about a class.
const DriftClassEntry& entry_of(DriftClass drift_class);

/// The class of that name. The name comes from a file; for an unknown one RunError names the nearest.
const DriftClassEntry& drift_class_named(std::string_view name);

/// The name, as in every file.
inline std::string_view to_string(DriftClass drift_class) { return entry_of(drift_class).name; }

}  // namespace pfaff
