// What a text model says, read and checked but not yet evaluated (docs/text-models.md).
//
// The words are those of core/system.hpp. Reading checks keys, names and which formulas belong together; what
// depends on parameters, such as sizes, is checked when a model is made (systems/text/model.hpp).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <pfaff/brackets/text/text_bracket.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/text/vocabulary.hpp>

namespace pfaff::text {

/// What is expected of an invariant, by its name. InputError with the nearest one where there is none.
Behaviour behaviour_named(const std::string& name);

struct TextInvariant {
  Invariant invariant;
  Expression of;
};

/// A formula as the expressions of its results, row by row where it is a matrix. Names are those of
/// constraints, where they have any.
struct TextFormula {
  std::vector<Expression> results;
  std::vector<std::string> names{};
  Source place;  // of its value
};

/// A bracket as the one that a name or a file has chosen, or as the rows of its tensor.
struct GivenBracket {
  ChosenBracket chosen{};
  std::vector<Expression> rows{};
  Source place;
};

/// A constraint row.v + offset = 0 of the velocities.
struct TextVelocityConstraint {
  std::string name;
  std::vector<Expression> row;
  std::optional<Expression> offset;
};

/// A part of the field that is solved exactly, by the change of the state in a time h.
struct TextPart {
  std::string name;
  TextFormula change;
  bool small = false;  // a perturbation of the other parts
};

struct TextDeclaration {
  std::string path, name, title, reference, description, time_unit;
  std::vector<TextParameter> parameters;
  std::vector<TextCoordinate> coordinates;
  std::vector<std::string> velocities;  // names of the velocities of a Lagrangian; empty: v[1], v[2], ...
  std::vector<std::string> chart_coordinates;  // names of chart coordinates; empty: y[1], y[2], ...
  std::vector<TextDefinition> definitions;
  std::optional<TextFormula> initial, initial_velocities, lagrangian, damping;
  std::array<std::optional<TextFormula>, formula_count> formulas;
  std::optional<GivenBracket> bracket, symmetric_bracket;
  std::vector<TextVelocityConstraint> velocity_constraints;
  std::vector<TextPart> parts;
  std::optional<Source> kepler_parts;  // instead: Kepler orbits and the interaction of bodies
  std::vector<TextInvariant> invariants;

  [[nodiscard]] const TextFormula* find(Formula formula) const {
    const auto& found = formulas[index(formula)];
    return found ? &*found : nullptr;
  }
  [[nodiscard]] bool has(Formula formula) const { return find(formula) != nullptr; }
  /// True where constraints of positions or of the phase space are given, or of velocities.
  [[nodiscard]] bool constrained() const {
    return has(Formula::holonomic) || has(Formula::constraints) || !velocity_constraints.empty();
  }
};

/// Reads what a document says, and the brackets that it names. TextError where it is no text model, and for a
/// bracket that does not exist.
TextDeclaration read_declaration(const Document& document);

/// Refuses formulas that do not belong together, and a model without any motion, at the place of one of them.
void check_formulas(const TextDeclaration& declaration, const Item& root);

}  // namespace pfaff::text
