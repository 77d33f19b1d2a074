#include <pfaff/core/facets/formula_rules.hpp>

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

void check_source(const ModelSource& source) {
  if (const auto broken = broken_rule(members_of(source)))
    throw InputError("system " + source.name + ": " + std::string(broken->message));
}

}  // namespace pfaff
