// Which members of a system belong together, one row a rule. This list is the only one: the assertions by
// which the compiler refuses a struct (system_formulas.hpp) and the messages by which a model made of text or
// in a program is refused (formula_rules.hpp) are made from it.
//
// Included wherever rows are turned into something else, so it has no include guard. `has` is the
// FormulaMembers of the system. A row is one of
//   PFAFF_RULE("member", condition, "message")     the message where the condition does not hold, at a member
//   PFAFF_TOGETHER(a, b, "sense")                  neither of two members is written without the other
//   PFAFF_BESIDE(member, condition, "members")     a member is written only beside others, named in words
//   PFAFF_WITHOUT(member, other, "sentence")       two members are not written together

// clang-format off
#ifndef PFAFF_RULE
#define PFAFF_RULE(...)
#endif
#define PFAFF_TOGETHER(a, b, sense) \
  PFAFF_RULE(#a, !has.a || has.b, #a " belongs together with " #b ", which is missing: " sense) \
  PFAFF_RULE(#b, !has.b || has.a, #b " belongs together with " #a ", which is missing: " sense)
#define PFAFF_BESIDE(member, condition, members) \
  PFAFF_RULE(#member, !has.member || (condition), #member " is written beside " members ", which is missing")
#define PFAFF_WITHOUT(member, other, sentence) \
  PFAFF_RULE(#member, !(has.member && has.other), sentence "; expected no " #other)

PFAFF_TOGETHER(kinetic, potential, "H = T(p, t) + V(q, t)")
PFAFF_TOGETHER(birkhoffian, one_form, "the action form F.dz - B dt")
PFAFF_TOGETHER(structure, covector, "K zdot + D = 0")
PFAFF_TOGETHER(chart, chart_inverse, "each undoes the other")
PFAFF_WITHOUT(structure, birkhoffian, "structure and covector are written instead of birkhoffian and one_form, from which they are derived")
PFAFF_BESIDE(force, has.kinetic, "kinetic and potential (what is something else needs another name)")
PFAFF_BESIDE(velocity, has.kinetic, "kinetic and potential (what is something else needs another name)")
PFAFF_BESIDE(damping, has.kinetic, "kinetic and potential")
PFAFF_BESIDE(bracket, has.hamiltonian, "hamiltonian")
PFAFF_BESIDE(chart_hamiltonian, has.chart, "chart and chart_inverse")
PFAFF_BESIDE(chart, has.form() || has.chart_hamiltonian, "birkhoffian and one_form, structure and covector, or chart_hamiltonian")
PFAFF_BESIDE(alpha, has.form() || has.canonical(), "birkhoffian and one_form, structure and covector, or a canonical energy")

PFAFF_WITHOUT(constraints, holonomic, "holonomic constraints imply the hidden ones, and constraints stand instead of them")
PFAFF_RULE("constraint_count", has.constraint_count == (has.holonomic || has.constraints), "constraint_count (a static constexpr int or a member function) and holonomic or constraints belong together: one of them is missing")
PFAFF_BESIDE(holonomic, has.canonical(), "a canonical energy (kinetic and potential, or hamiltonian without bracket)")
PFAFF_BESIDE(constraints, has.energy(), "hamiltonian, or kinetic and potential")
PFAFF_BESIDE(constraint_gradients, has.constraints, "constraints")
PFAFF_BESIDE(friction, has.holonomic, "holonomic")
PFAFF_BESIDE(constraint_evaluator, has.holonomic, "holonomic")
PFAFF_RULE("damping", !(has.applied_force && has.damping), "damping beside applied_force: expected -nu p as a part of applied_force instead")
PFAFF_BESIDE(applied_force, has.canonical() || has.damping, "a canonical energy (kinetic and potential, or hamiltonian without bracket)")
PFAFF_WITHOUT(applied_force, constraints, "applied_force stands beside an energy, holonomic and velocity constraints")
PFAFF_WITHOUT(applied_force, alpha, "applied_force stands beside an energy, holonomic and velocity constraints")
PFAFF_WITHOUT(applied_force, symmetric_bracket, "applied_force stands beside an energy, holonomic and velocity constraints")
PFAFF_WITHOUT(applied_force, constraint_evaluator, "applied_force stands beside an energy, holonomic and velocity constraints")
PFAFF_TOGETHER(velocity_constraints, velocity_constraint_count, "how many rows there are")
PFAFF_BESIDE(velocity_offsets, has.velocity_constraints, "velocity_constraints")
PFAFF_BESIDE(velocity_constraints, has.canonical(), "a canonical energy (kinetic and potential, or hamiltonian without bracket)")
PFAFF_WITHOUT(velocity_constraints, constraints, "velocity_constraints stand beside holonomic constraints, or alone")

PFAFF_TOGETHER(part_flow, part_count, "a static constexpr int or a member function says how many parts there are")
PFAFF_BESIDE(small_part, has.part_flow, "part_flow")
PFAFF_BESIDE(symmetric_bracket, has.energy(), "hamiltonian, or kinetic and potential")
PFAFF_BESIDE(entropy, has.symmetric_bracket, "symmetric_bracket")
PFAFF_RULE("", has.field || has.kinetic || has.lagrangian || has.hamiltonian || has.birkhoffian || has.structure, "this system has no vector field; expected one of field, kinetic and potential, hamiltonian, birkhoffian and one_form, structure and covector, or in a text model lagrangian")
// clang-format on

#undef PFAFF_RULE
#undef PFAFF_TOGETHER
#undef PFAFF_BESIDE
#undef PFAFF_WITHOUT
