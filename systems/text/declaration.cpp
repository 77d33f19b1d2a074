#include <pfaff/systems/text/declaration.hpp>

#include <algorithm>
#include <filesystem>

#include <pfaff/core/registry/registry.hpp>
#include <pfaff/core/text/lexer.hpp>

namespace pfaff::text {

Behaviour behaviour_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Behaviour b :
       {Behaviour::conserved, Behaviour::decreasing, Behaviour::increasing, Behaviour::free}) {
    if (name == to_string(b)) return b;
    names.emplace_back(to_string(b));
  }
  throw InputError(unknown_name("behaviour", name, names));
}

namespace {
using Kind = Item::Kind;

// The formulas that are one expression, a list of them or the rows of a matrix, by their keys.
constexpr std::array written{
    Formula::field,          Formula::hamiltonian,       Formula::kinetic,     Formula::potential,
    Formula::force,          Formula::velocity,          Formula::birkhoffian, Formula::one_form,
    Formula::structure,      Formula::covector,          Formula::chart,       Formula::chart_inverse,
    Formula::chart_field,    Formula::chart_hamiltonian, Formula::holonomic,   Formula::friction,
    Formula::constraints,    Formula::applied_force,     Formula::entropy,     Formula::casimirs,
    Formula::exact_solution, Formula::reversal};

std::vector<std::string> read_names(const Item& value, const std::string& what, TakenNames& names) {
  if (value.kind != Kind::list) refuse(value, what + ": expected a list of names");
  std::vector<std::string> list;
  for (const Item& item : value.items) {
    list.push_back(text_of(item, what));
    names.take(item.source, list.back(), what);
  }
  return list;
}

// Keys that are names of columns in files.
void require_label(const Member& member) {
  if (!std::all_of(member.key.begin(), member.key.end(),
                   [](char c) { return is_identifier(std::string("_") + c) || c == '-' || c == '~'; }) ||
      member.key.empty())
    refuse(member.place, 0, "the name '" + member.key + "': expected letters, digits, - and _");
}

// One expression, a list or a list of rows; of constraints also a table in which each has a name.
TextFormula read_formula(const Item& value, const std::string& key, bool named = false) {
  TextFormula formula{.results = {}, .place = value.source};
  if (value.kind == Kind::list) {
    for (const Item& item : value.items) {
      const auto row = item.kind == Kind::list ? expressions_of(item, key)
                                               : std::vector<Expression>{expression_of(item, key)};
      formula.results.insert(formula.results.end(), row.begin(), row.end());
    }
  } else if (value.kind == Kind::table) {
    if (!named) refuse(value, key + ": expected expressions in their order, without names");
    for (const Member& member : value.members) {
      require_label(member);
      formula.names.push_back(member.key);
      formula.results.push_back(expression_of(member.value, key + " '" + member.key + "'"));
    }
  } else {
    formula.results.push_back(expression_of(value, key));
  }
  return formula;
}

GivenBracket read_bracket(const Item& value, const std::string& key, const std::string& path) {
  if (value.kind == Kind::text) {
    try {
      return {chosen_bracket(value.source.text, path), {}, value.source};
    } catch (const TextError&) {
      throw;
    } catch (const InputError& error) {
      refuse(value, key + ": " + error.what());
    }
  }
  if (value.kind != Kind::list)
    refuse(value, key + ": expected the name of a bracket, a file or rows of expressions");
  return {{}, read_formula(value, key).results, value.source};
}

Behaviour read_behaviour(const Item& value) {
  const std::string& text = text_of(value, "behaviour");
  try {
    return behaviour_named(text);
  } catch (const InputError& error) {
    refuse(value, error.what());
  }
}

TextInvariant read_invariant(const Member& member) {
  const std::string what = "invariant '" + member.key + "'";
  Invariant invariant = conserved(member.key, "");
  if (member.value.kind != Kind::table) return {std::move(invariant), expression_of(member.value, what)};
  Table table(member.value, what);
  if (const Item* unit = table.find("unit")) invariant.unit = label_of(*unit, "unit");
  Expression of = expression_of(table.required("of"), what);
  if (const Item* quadratic = table.find("quadratic"))
    invariant.quadratic = truth_of(*quadratic, "quadratic");
  if (const Item* behaviour = table.find("behaviour")) invariant.behaviour = read_behaviour(*behaviour);
  table.finish();
  return {std::move(invariant), std::move(of)};
}

std::vector<TextVelocityConstraint> read_velocity_constraints(const Item& value) {
  if (value.kind != Kind::list)
    refuse(value, "velocity_constraints: expected a list of { row = [...], b = ... }");
  std::vector<TextVelocityConstraint> list;
  for (const Item& item : value.items) {
    Table table(item, "velocity constraint");
    TextVelocityConstraint one;
    one.row = expressions_of(table.required("row"), "row");
    if (const Item* offset = table.find("b")) one.offset = expression_of(*offset, "b");
    const Item* name = table.find("name");
    one.name = name == nullptr ? "psi" + std::to_string(list.size() + 1) : label_of(*name, "name");
    table.finish();
    list.push_back(std::move(one));
  }
  return list;
}

std::vector<TextPart> read_parts(const Item& value) {
  if (value.kind != Kind::list || value.items.empty())
    refuse(value, "parts: expected a list of { name = ..., change = [...] }, or \"kepler\"");
  std::vector<TextPart> list;
  for (const Item& item : value.items) {
    Table table(item, "part");
    const std::string name = label_of(table.required("name"), "name");
    TextPart part{name, read_formula(table.required("change"), "change of '" + name + "'")};
    if (const Item* small = table.find("small")) {
      part.small = truth_of(*small, "small");
      if (part.small && std::any_of(list.begin(), list.end(), [](const TextPart& p) { return p.small; }))
        refuse(*small, "part '" + name + "': expected one small part at most");
    }
    table.finish();
    list.push_back(std::move(part));
  }
  return list;
}

// alpha = { w_hat = [...], w = [...] }, whose results stand one behind the other.
TextFormula read_alpha(const Item& value) {
  Table table(value, "alpha");
  TextFormula formula = read_formula(table.required("w_hat"), "w_hat");
  const TextFormula second = read_formula(table.required("w"), "w");
  table.finish();
  formula.results.insert(formula.results.end(), second.results.begin(), second.results.end());
  return formula;
}
}  // namespace

TextDeclaration read_declaration(const Document& document) {
  Table root(document.root, "a text model");
  TextDeclaration d;
  d.path = document.path;
  d.name = root.text("name", std::filesystem::path(document.path).stem().string());
  if (!is_kebab_case(d.name)) {
    const Item* place = root.find("name");
    refuse(place != nullptr ? *place : document.root,
           "the name '" + d.name + "': expected kebab-case, such as 'damped-pendulum'");
  }
  d.title = root.text("title", d.name);
  d.reference = root.text("reference");
  d.description = root.text("description");
  const Item* unit = root.find("time_unit");
  d.time_unit = unit == nullptr ? "s" : label_of(*unit, "time_unit");

  TakenNames names;
  if (const Item* value = root.find("parameters")) d.parameters = read_parameters(*value, names);
  d.coordinates = read_coordinates(root.required("coordinates"), names);
  if (const Item* list = root.find("velocities")) d.velocities = read_names(*list, "velocity", names);
  if (const Item* list = root.find("chart_coordinates"))
    d.chart_coordinates = read_names(*list, "chart coordinate", names);
  if (const Item* value = root.find("let")) d.definitions = read_definitions(*value, names);
  if (const Item* value = root.find("initial")) d.initial = read_formula(*value, "initial");
  if (const Item* value = root.find("initial_velocities"))
    d.initial_velocities = read_formula(*value, "initial_velocities");
  if (const Item* value = root.find("lagrangian")) d.lagrangian = read_formula(*value, "lagrangian");
  if (const Item* value = root.find("damping")) d.damping = read_formula(*value, "damping");
  for (const Formula formula : written) {
    const std::string key(to_string(formula));
    if (const Item* value = root.find(key))
      d.formulas[index(formula)] =
          read_formula(*value, key, formula == Formula::holonomic || formula == Formula::constraints);
  }
  if (const Item* value = root.find("alpha")) d.formulas[index(Formula::alpha)] = read_alpha(*value);
  if (const Item* value = root.find("bracket")) d.bracket = read_bracket(*value, "bracket", d.path);
  if (const Item* value = root.find("symmetric_bracket"))
    d.symmetric_bracket = read_bracket(*value, "symmetric_bracket", d.path);
  if (const Item* value = root.find("velocity_constraints"))
    d.velocity_constraints = read_velocity_constraints(*value);
  if (const Item* value = root.find("parts"); value != nullptr && value->kind == Kind::text) {
    if (value->source.text != "kepler")
      refuse(*value, unknown_name("splitting", value->source.text, {"kepler"}));
    d.kepler_parts = value->source;
  } else if (value != nullptr) {
    names.take(value->source, "h", "time of a flow");
    d.parts = read_parts(*value);
  }
  if (const Item* value = root.find("invariants")) {
    if (value->kind != Kind::table) refuse(*value, "invariants: expected a table of names and expressions");
    for (const Member& member : value->members) {
      require_label(member);
      d.invariants.push_back(read_invariant(member));
    }
  }
  // Where chart coordinates and velocities have no names of their own, they are y[1], ... and v[1], ...
  if (d.has(Formula::chart) && d.chart_coordinates.empty())
    names.take(d.find(Formula::chart)->place, "y", "chart coordinate");
  if (d.lagrangian && d.velocities.empty()) names.take(d.lagrangian->place, "v", "velocity");
  root.finish();
  check_formulas(d, document.root);
  return d;
}

}  // namespace pfaff::text
