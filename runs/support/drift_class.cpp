#include <pfaff/runs/support/drift_class.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

#include <pfaff/core/errors/errors.hpp>

namespace pfaff {

const std::vector<DriftClassEntry>& drift_classes() {
  static const std::vector<DriftClassEntry> entries{
      {DriftClass::exact, "exact", "every error is zero", "", false, true},
      {DriftClass::round_off, "round-off",
       "the error is no larger than the roundings of as many steps add up to by chance", "max", false, true},
      {DriftClass::biased_round_off, "biased-round-off",
       "a trend of less than one unit of round-off a step, as roundings have that add up in one direction",
       "slope", true, false},
      {DriftClass::bounded, "bounded", "noise or oscillation about one level, without a trend", "max", false,
       true},
      {DriftClass::random_walk, "random-walk",
       "no trend, but the error wanders off with a power of time: the power 1/2 for independent roundings",
       "exponent", true, false},
      {DriftClass::linear, "linear", "a trend in proportion to time", "slope", true, false},
      {DriftClass::polynomial, "polynomial", "a trend that grows with a higher power of time", "exponent",
       true, false},
      {DriftClass::exponential, "exponential", "the error grows by the same factor in equal times", "max",
       true, false},
      {DriftClass::undetermined, "undetermined",
       "the samples do not tell: there are too few, one is not finite, or the error follows none of the "
       "other "
       "classes",
       "max", false, false}};
  return entries;
}

const DriftClassEntry& entry_of(DriftClass drift_class) {
  const auto& all = drift_classes();
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const DriftClassEntry& entry) { return entry.drift_class == drift_class; });
  if (found == all.end()) throw std::logic_error("a drift class is not in the list of drift_class.cpp");
  return *found;
}

const DriftClassEntry& drift_class_named(std::string_view name) {
  std::vector<std::string> names;
  for (const DriftClassEntry& entry : drift_classes()) {
    if (entry.name == name) return entry;
    names.emplace_back(entry.name);
  }
  throw RunError(unknown_name("drift class", name, names));
}

}  // namespace pfaff
