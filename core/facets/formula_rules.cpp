#include <pfaff/core/facets/formula_rules.hpp>

#include <algorithm>
#include <string_view>
#include <unordered_set>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/model.hpp>

namespace pfaff {

FormulaMembers members_of(const ModelSource& source) {
  const auto given = [&](Formula formula) {
    return source.given[index(formula)] != nullptr || source.programs[index(formula)] != nullptr;
  };
  FormulaMembers has;
#define PFAFF_FORMULA(name, ...) has.name = given(Formula::name);
#include <pfaff/core/facets/formula_rows.hpp>
  has.bracket = given(Formula::poisson_tensor);
  has.symmetric_bracket = given(Formula::symmetric_tensor);
  has.damping = source.damping.has_value();
  has.constraint_evaluator = source.holonomic != nullptr;
  has.part_flow = source.flows != nullptr;
  has.small_part = source.small_part.has_value();
  // Numbers follow from the formulas, and may be zero; a name of what is not there is one too many.
  has.constraint_count = has.holonomic || has.constraints || !source.constraint_names.empty();
  has.velocity_constraint_count = has.velocity_constraints || !source.velocity_constraint_names.empty();
  has.part_count = has.part_flow;
  return has;
}

std::optional<BrokenRule> broken_rule(const FormulaMembers& has) {
#define PFAFF_RULE(member, condition, message) \
  if (!(condition)) return BrokenRule{member, message};
#include <pfaff/core/facets/rule_rows.hpp>
  return std::nullopt;
}

namespace {
// What stands at the head of a column and before '=': other letters would break tables and files.
bool names_a_column(const std::string& name) {
  const bool plain = std::none_of(name.begin(), name.end(), [](char c) {
    return c == ',' || c == '"' || c == '=' || static_cast<unsigned char>(c) < ' ' || c == '\x7f';
  });
  return plain && !name.empty() && name.front() != ' ' && name.back() != ' ';
}

template <class Named>
void check_names(const std::string& system, const char* kind, const std::vector<Named>& list) {
  const auto what = [&](const std::string& name) {
    return "system " + system + ": the name '" + on_one_line(name) + "' of " + kind;
  };
  std::unordered_set<std::string_view> taken;  // there may be a hundred thousand
  for (const Named& one : list) {
    if (!names_a_column(one.name))
      throw InputError(what(one.name) + "; expected letters without commas, quotation marks and '='");
    if (!taken.insert(one.name).second)
      throw InputError(what(one.name) + " stands twice; expected names that differ");
  }
}
}  // namespace

void check_source(const ModelSource& source) {
  check_names(source.name, "a coordinate", source.coordinates);
  check_names(source.name, "an invariant", source.invariants);
  const std::size_t named = source.coordinates.size();
  if (named != 0 && named != static_cast<std::size_t>(source.dimension))
    throw InputError("system " + source.name + " names " + std::to_string(named) + " coordinates; expected " +
                     std::to_string(source.dimension));
  if (const auto broken = broken_rule(members_of(source)))
    throw InputError("system " + source.name + ": " + std::string(broken->message));
}

}  // namespace pfaff
