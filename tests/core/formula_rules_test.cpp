// Which members of a system belong together (core/facets/rule_rows.hpp): every rule is broken once, by
// members that keep all rules before it. That structs are refused with the same words the compiler shows
// (refused/).
#include <gtest/gtest.h>

#include <set>

#include <pfaff/core/errors/errors.hpp>
#include <pfaff/core/facets/formula_rules.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/tape/recorder.hpp>

namespace {
using namespace pfaff;
using M = FormulaMembers;
using Written = std::vector<bool M::*>;

M members(const Written& written) {
  M has;
  for (bool M::*member : written) has.*member = true;
  return has;
}

const Written energies{&M::kinetic, &M::potential};
Written beside_energies(Written more) {
  more.insert(more.end(), energies.begin(), energies.end());
  return more;
}

// Members, the one at which a rule is broken, and how its message begins.
struct Broken {
  Written written;
  std::string member, message;
};

const std::vector<Broken>& broken() {
  static const std::vector<Broken> list{
      {{&M::kinetic}, "kinetic", "kinetic belongs together with potential, which is missing: H = T"},
      {{&M::potential}, "potential", "potential belongs together with kinetic, which is missing"},
      {{&M::birkhoffian}, "birkhoffian", "birkhoffian belongs together with one_form, which is"},
      {{&M::one_form}, "one_form", "one_form belongs together with birkhoffian, which is missing"},
      {{&M::structure}, "structure", "structure belongs together with covector, which is missing"},
      {{&M::covector}, "covector", "covector belongs together with structure, which is missing"},
      {{&M::chart}, "chart", "chart belongs together with chart_inverse, which is missing"},
      {{&M::chart_inverse}, "chart_inverse", "chart_inverse belongs together with chart, which is"},
      {{&M::structure, &M::covector, &M::birkhoffian, &M::one_form},
       "structure",
       "structure and covector are written instead of birkhoffian and one_form, from which they are derived; "
       "expected no birkhoffian"},
      {{&M::field, &M::force}, "force", "force is written beside kinetic and potential (what is"},
      {{&M::field, &M::velocity}, "velocity", "velocity is written beside kinetic and potential"},
      {{&M::hamiltonian, &M::damping}, "damping", "damping is written beside kinetic and potential, which"},
      {{&M::field, &M::bracket}, "bracket", "bracket is written beside hamiltonian, which is missing"},
      {{&M::field, &M::chart_hamiltonian},
       "chart_hamiltonian",
       "chart_hamiltonian is written beside chart and chart_inverse, which is missing"},
      {{&M::field, &M::chart, &M::chart_inverse},
       "chart",
       "chart is written beside birkhoffian and one_form, structure and covector, or chart_hamiltonian"},
      {{&M::field, &M::alpha}, "alpha", "alpha is written beside birkhoffian and one_form, structure and"},
      {beside_energies({&M::holonomic, &M::constraints, &M::constraint_count}), "constraints",
       "holonomic constraints imply the hidden ones, and constraints stand instead of them; expected no "
       "holonomic"},
      {beside_energies({&M::holonomic}), "constraint_count",
       "constraint_count (a static constexpr int or a member function) and holonomic or constraints belong "
       "together: one of them is missing"},
      {beside_energies({&M::constraint_count}), "constraint_count", "constraint_count (a static"},
      {{&M::hamiltonian, &M::bracket, &M::holonomic, &M::constraint_count},
       "holonomic",
       "holonomic is written beside a canonical energy (kinetic and potential, or hamiltonian without"},
      {beside_energies({&M::damping, &M::constraints, &M::constraint_count}), "constraints",
       "constraints is written beside hamiltonian, or kinetic and potential, which is missing"},
      {beside_energies({&M::constraint_gradients}), "constraint_gradients",
       "constraint_gradients is written beside constraints, which is missing"},
      {beside_energies({&M::friction}), "friction", "friction is written beside holonomic, which is missing"},
      {beside_energies({&M::constraint_evaluator}), "constraint_evaluator",
       "constraint_evaluator is written beside holonomic, which is missing"},
      {beside_energies({&M::damping, &M::applied_force}), "damping",
       "damping beside applied_force: expected -nu p as a part of applied_force instead"},
      {{&M::field, &M::applied_force}, "applied_force", "applied_force is written beside a canonical energy"},
      {beside_energies({&M::applied_force, &M::constraints, &M::constraint_count}), "applied_force",
       "applied_force stands beside an energy, holonomic and velocity constraints; expected no constraints"},
      {beside_energies({&M::applied_force, &M::alpha}), "applied_force",
       "applied_force stands beside an energy, holonomic and velocity constraints; expected no alpha"},
      {beside_energies({&M::applied_force, &M::symmetric_bracket}), "applied_force",
       "applied_force stands beside an energy, holonomic and velocity constraints; expected no symmetric_"},
      {beside_energies({&M::applied_force, &M::holonomic, &M::constraint_count, &M::constraint_evaluator}),
       "applied_force",
       "applied_force stands beside an energy, holonomic and velocity constraints; expected no constraint_e"},
      {beside_energies({&M::velocity_constraints}), "velocity_constraints",
       "velocity_constraints belongs together with velocity_constraint_count, which is missing"},
      {beside_energies({&M::velocity_constraint_count}), "velocity_constraint_count",
       "velocity_constraint_count belongs together with velocity_constraints, which is missing"},
      {beside_energies({&M::velocity_offsets}), "velocity_offsets",
       "velocity_offsets is written beside velocity_constraints, which is missing"},
      {{&M::field, &M::velocity_constraints, &M::velocity_constraint_count},
       "velocity_constraints",
       "velocity_constraints is written beside a canonical energy (kinetic and potential, or hamiltonian"},
      {beside_energies(
           {&M::constraints, &M::constraint_count, &M::velocity_constraints, &M::velocity_constraint_count}),
       "velocity_constraints",
       "velocity_constraints stand beside holonomic constraints, or alone; expected no constraints"},
      {beside_energies({&M::part_flow}), "part_flow", "part_flow belongs together with part_count, which"},
      {beside_energies({&M::part_count}), "part_count", "part_count belongs together with part_flow"},
      {beside_energies({&M::small_part}), "small_part", "small_part is written beside part_flow, which is"},
      {{&M::field, &M::symmetric_bracket},
       "symmetric_bracket",
       "symmetric_bracket is written beside hamiltonian, or kinetic and potential, which is missing"},
      {beside_energies({&M::entropy}), "entropy", "entropy is written beside symmetric_bracket, which is"},
      {{&M::invariants},
       "",
       "this system has no vector field; expected one of field, kinetic and potential"}};
  return list;
}

TEST(FormulaRules, EveryRuleIsBrokenOnce) {
  std::set<std::string> given, all;
  for (const Broken& b : broken()) {
    const auto rule = broken_rule(members(b.written));
    ASSERT_TRUE(rule.has_value()) << b.message;
    EXPECT_EQ(rule->member, b.member);
    EXPECT_EQ(rule->message.substr(0, b.message.size()), b.message);
    given.emplace(rule->message);
  }
#define PFAFF_RULE(member, condition, message) all.insert(message);
#include <pfaff/core/facets/rule_rows.hpp>
  EXPECT_EQ(given, all);
}

// The control: what belongs together is not refused.
TEST(FormulaRules, WhatBelongsTogetherIsKept) {
  for (const Written& written :
       {Written{&M::field}, energies, beside_energies({&M::damping}), beside_energies({&M::applied_force}),
        Written{&M::lagrangian}, Written{&M::hamiltonian, &M::bracket},
        Written{&M::birkhoffian, &M::one_form, &M::chart, &M::chart_inverse, &M::alpha},
        Written{&M::structure, &M::covector}, Written{&M::hamiltonian, &M::symmetric_bracket, &M::entropy},
        Written{&M::chart, &M::chart_inverse, &M::chart_hamiltonian, &M::field},
        beside_energies({&M::holonomic, &M::constraint_count, &M::friction, &M::constraint_evaluator}),
        Written{&M::hamiltonian, &M::bracket, &M::constraints, &M::constraint_count,
                &M::constraint_gradients},
        beside_energies({&M::holonomic, &M::constraint_count, &M::velocity_constraints,
                         &M::velocity_constraint_count, &M::velocity_offsets}),
        beside_energies({&M::part_flow, &M::part_count, &M::small_part})})
    EXPECT_FALSE(broken_rule(members(written)).has_value()) << broken_rule(members(written))->message;
}

TEST(FormulaRules, AModelIsRefusedInTheSameWords) {
  ModelSource source;
  source.name = "half";
  source.dimension = 2;
  const auto refused = [&]() -> std::string {
    try {
      Model{source};
      return "accepted";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const auto tape = std::make_shared<const Tape>(
      record(1, 1, [](const Recorded&, In<Recorded> x, Out<Recorded> out) { out[0] = x[0] * x[0]; }));
  EXPECT_EQ(refused().find("system half: this system has no vector field"), 0U);
  source.given[index(Formula::kinetic)] = tape;
  EXPECT_EQ(refused(),
            "system half: kinetic belongs together with potential, which is missing: H = T(p, t) + V(q, t)");
  source.given[index(Formula::potential)] = tape;
  EXPECT_EQ(refused(), "accepted");
  source.constraint_names = {"phi1"};
  EXPECT_EQ(refused().find("system half: constraint_count "), 0U);
}
// What stands at the head of a column is the name of one.
TEST(FormulaRules, NamesAreDistinctAndFitATable) {
  const auto refusal = [](const std::vector<Coordinate>& coordinates,
                          const std::vector<Invariant>& invariants) {
    ModelSource source;
    source.name = "s";
    source.dimension = 2;
    source.coordinates = coordinates;
    source.invariants = invariants;
    source.given[index(Formula::field)] = std::make_shared<const Tape>(record(
        2, 2, [](const Recorded&, In<Recorded> z, Out<Recorded> out) { out[0] = z[1], out[1] = z[0]; }));
    try {
      check_source(source);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal({{"q", "m"}, {"p", ""}}, {conserved("energy", "J")}), "");
  EXPECT_EQ(refusal({}, {}), "");  // named by nobody
  EXPECT_EQ(refusal({{"q", ""}}, {}), "system s names 1 coordinates; expected 2");
  EXPECT_EQ(refusal({{"q", ""}, {"q", ""}}, {}),
            "system s: the name 'q' of a coordinate stands twice; expected names that differ");
  for (const char* name : {"", "q,1", "a\"b", "x=y", " q", "q "})
    EXPECT_NE(refusal({{name, ""}, {"p", ""}}, {}).find("of a coordinate; expected letters"),
              std::string::npos)
        << name;
  EXPECT_EQ(refusal({{"q", ""}, {"p", ""}}, {conserved("e", ""), conserved("e", "")}),
            "system s: the name 'e' of an invariant stands twice; expected names that differ");
}

}  // namespace
