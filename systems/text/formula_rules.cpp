// Which formulas of a text model belong together. The rules are those of core/facets/system_formulas.hpp.
#include <algorithm>

#include <pfaff/systems/text/declaration.hpp>

namespace pfaff::text {

void check_formulas(const TextDeclaration& d, const Item& root) {
  using enum Formula;
  const auto has = [&](Formula f) { return d.has(f); };
  // Throws where a rule is broken, at the place of a key.
  const auto rule = [&](bool holds, std::string_view key, const std::string& message) {
    if (holds) return;
    const auto place = std::find_if(root.members.begin(), root.members.end(),
                                    [&](const Member& member) { return member.key == key; });
    if (place == root.members.end()) refuse(root, message);
    refuse(place->place, 0, message);
  };
  // One of two keys that belong together.
  const auto pair = [&](Formula a, Formula b) {
    const Formula there = has(a) ? a : b, missing = has(a) ? b : a;
    rule(has(a) == has(b), to_string(there),
         std::string(to_string(there)) + " belongs together with " + std::string(to_string(missing)) +
             ", which is missing");
  };
  const auto beside = [&](bool there, bool base, const std::string& key, const std::string& expected) {
    rule(!there || base, key, key + " is written beside " + expected + ", which is missing");
  };
  pair(kinetic, potential);
  pair(birkhoffian, one_form);
  pair(structure, covector);
  pair(chart, chart_inverse);
  const bool lagrangian = d.lagrangian.has_value(), bracket = d.bracket.has_value();
  const bool energies = has(kinetic) || lagrangian, energy = energies || has(hamiltonian);
  const bool canonical = (energies && !d.damping) || (has(hamiltonian) && !bracket);
  rule(!lagrangian || !(has(kinetic) || has(hamiltonian)), "lagrangian",
       "the energy follows from the lagrangian; expected no kinetic, potential or hamiltonian beside it");
  rule(!lagrangian || !d.damping, "damping",
       "damping is written beside kinetic and potential, not a lagrangian");
  rule(!(has(structure) && has(birkhoffian)), "structure",
       "structure and covector are written instead of birkhoffian and one_form; expected one pair");
  beside(has(force), has(kinetic), "force", "kinetic and potential");
  beside(has(velocity), has(kinetic), "velocity", "kinetic and potential");
  beside(d.damping.has_value(), has(kinetic), "damping", "kinetic and potential");
  beside(bracket, has(hamiltonian), "bracket", "hamiltonian");
  beside(has(casimirs), bracket && !d.bracket->rows.empty(), "casimirs", "the rows of a bracket");
  beside(has(chart_hamiltonian), has(chart), "chart_hamiltonian", "chart and chart_inverse");
  const bool form = has(birkhoffian) || has(structure);
  beside(has(chart), form || has(chart_hamiltonian), "chart",
         "birkhoffian and one_form, structure and covector, or chart_hamiltonian");
  beside(has(alpha), form || canonical, "alpha",
         "birkhoffian and one_form, structure and covector, or a canonical energy");
  beside(has(holonomic), canonical, "holonomic", "a canonical energy");
  beside(has(constraints), energy && !d.damping, "constraints", "hamiltonian, or kinetic and potential");
  beside(has(friction), has(holonomic), "friction", "holonomic");
  rule(!(has(applied_force) && d.damping), "damping",
       "damping beside applied_force: expected -nu p as a part of applied_force instead");
  beside(has(applied_force), canonical, "applied_force", "a canonical energy");
  for (const auto& [there, key] : {std::pair(has(constraints), "constraints"), std::pair(has(alpha), "alpha"),
                                   std::pair(d.symmetric_bracket.has_value(), "symmetric_bracket")})
    rule(!(has(applied_force) && there), "applied_force",
         std::string(
             "applied_force stands beside an energy, holonomic and velocity constraints; expected no ") +
             key);
  const bool velocities = !d.velocity_constraints.empty();
  beside(velocities, canonical, "velocity_constraints", "a canonical energy");
  rule(!(has(holonomic) && has(constraints)), "constraints",
       "holonomic constraints imply the hidden ones; expected either holonomic or constraints");
  rule(!(velocities && has(constraints)), "constraints",
       "velocity_constraints stand beside holonomic constraints, or alone; expected no constraints");
  beside(d.symmetric_bracket.has_value(), energy && !d.damping, "symmetric_bracket",
         "hamiltonian, or kinetic and potential");
  beside(has(entropy), d.symmetric_bracket.has_value(), "entropy", "symmetric_bracket");
  rule(!d.kepler_parts || (energies && !d.damping), "parts",
       "parts = \"kepler\" is written beside kinetic and potential, or a lagrangian, without damping");
  beside(d.initial_velocities.has_value(), d.initial.has_value(), "initial_velocities",
         "initial, with the positions alone");
  beside(d.initial_velocities.has_value(), canonical || d.damping, "initial_velocities",
         "a canonical energy");
  rule(!d.initial_velocities || !(has(constraints) || d.symmetric_bracket), "initial_velocities",
       "momenta do not follow from velocities in which constraints of the phase space or a second bracket "
       "take part; expected all of the state in initial");
  beside(!d.velocities.empty(), lagrangian, "velocities", "lagrangian");
  beside(!d.chart_coordinates.empty(), has(chart), "chart_coordinates", "chart and chart_inverse");
  rule(has(field) || energy || form, "",
       "a text model without motion; expected one of field, kinetic and potential, hamiltonian, lagrangian, "
       "birkhoffian and one_form, structure and covector");
}

}  // namespace pfaff::text
