// Formulas that an author has written although they could be derived: each must agree with the derived one.
#include <algorithm>

#include <pfaff/bench/verification/residuals.hpp>

namespace pfaff {

namespace {

// The results first .. first + count - 1 of the written formula minus those of the derived one.
std::shared_ptr<const Tape> tape_of_difference(const Tape& written, const Tape& derived, std::size_t first,
                                               std::size_t count) {
  return expression(written.inputs, static_cast<int>(count),
                    [&](const Recorded& t, Arguments z, Results out) {
                      const auto a = evaluate(written, t, z), b = evaluate(derived, t, z);
                      for (std::size_t k = 0; k < count; ++k) out[k] = a[first + k] - b[first + k];
                    });
}

// "chart_field" as "chart field".
std::string spoken(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace

std::vector<Check> check_overrides(const std::string& plugin, const Model& model, const Region& region) {
  std::vector<Check> checks;
  for (const FormulaRow& row : formula_table) {
    if (!row.traits.unique || !model.given(row.formula)) continue;
    // For a system with constraints the formulas alone make the field without reactions, which is not that of
    // its motion.
    if (row.formula == Formula::field && model.restricted()) continue;
    // Zero where they are left out, which is a default: nothing says what they should be.
    if (row.formula == Formula::velocity_offsets) continue;
    const auto derived = model.derived(row.formula);
    if (derived == nullptr) continue;
    const auto written = model.tape(row.formula);
    const Region where = region.first(static_cast<std::size_t>(written->inputs));
    const auto compare = [&](const std::string& what, std::size_t first, std::size_t count) {
      both(checks, plugin, "written " + what + " is the derived one", plugin,
           tape_of_difference(*written, *derived, first, count), where);
    };
    if (row.formula == Formula::constraint_gradients) {
      const std::vector<std::string> names = model.constraint_names();
      const std::size_t size = region.centres.front().size();
      for (std::size_t i = 0; i < names.size(); ++i) compare("gradient of " + names[i], i * size, size);
    } else {
      compare(spoken(row.name), 0, written->outputs.size());
    }
  }
  return checks;
}

}  // namespace pfaff
