// Which keys of a text model belong together: the rules of every system (core/facets/rule_rows.hpp), and
// those of keys that only text models have.
#include <algorithm>

#include <pfaff/core/facets/formula_rules.hpp>
#include <pfaff/systems/text/declaration.hpp>

namespace pfaff::text {

namespace {
FormulaMembers members_of(const TextDeclaration& d) {
  FormulaMembers has;
#define PFAFF_FORMULA(name, ...) has.name = d.has(Formula::name);
#include <pfaff/core/facets/formula_rows.hpp>
  has.lagrangian = d.lagrangian.has_value();
  has.bracket = d.bracket.has_value();
  has.symmetric_bracket = d.symmetric_bracket.has_value();
  has.damping = d.damping.has_value();
  has.velocity_constraints = has.velocity_constraint_count = !d.velocity_constraints.empty();
  has.constraint_count = has.holonomic || has.constraints;
  has.part_flow = has.part_count = !d.parts.empty() || d.kepler_parts;
  return has;
}
}  // namespace

void check_formulas(const TextDeclaration& d, const Item& root) {
  const FormulaMembers has = members_of(d);
  // Throws where a rule is broken, at the place of a key.
  const auto rule = [&](bool holds, std::string_view key, const std::string& message) {
    if (holds) return;
    const auto place = std::find_if(root.members.begin(), root.members.end(),
                                    [&](const Member& member) { return member.key == key; });
    if (place == root.members.end()) refuse(root, message);
    refuse(place->place, 0, message);
  };
  const auto beside = [&](bool there, bool base, const std::string& key, const std::string& expected) {
    rule(!there || base, key, key + " is written beside " + expected + ", which is missing");
  };
  rule(!has.lagrangian || !(has.kinetic || has.hamiltonian), "lagrangian",
       "the energy follows from the lagrangian; expected no kinetic, potential or hamiltonian beside it");
  rule(!has.lagrangian || !has.damping, "damping",
       "damping is written beside kinetic and potential, not a lagrangian");
  if (const auto broken = broken_rule(has)) rule(false, broken->member, std::string(broken->message));
  beside(d.has(Formula::casimirs), d.bracket && !d.bracket->rows.empty(), "casimirs",
         "the rows of a bracket");
  rule(!d.kepler_parts || has.separable(), "parts",
       "parts = \"kepler\" is written beside kinetic and potential, or a lagrangian, without damping");
  beside(d.initial_velocities.has_value(), d.initial.has_value(), "initial_velocities",
         "initial, with the positions alone");
  beside(d.initial_velocities.has_value(), has.canonical() || has.damping, "initial_velocities",
         "a canonical energy");
  rule(!d.initial_velocities || !(has.constraints || has.symmetric_bracket), "initial_velocities",
       "momenta do not follow from velocities in which constraints of the phase space or a second bracket "
       "take part; expected all of the state in initial");
  beside(!d.velocities.empty(), has.lagrangian, "velocities", "lagrangian");
  beside(!d.chart_coordinates.empty(), has.chart, "chart_coordinates", "chart and chart_inverse");
}

}  // namespace pfaff::text
