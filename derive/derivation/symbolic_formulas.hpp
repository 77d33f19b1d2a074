// What equations of holonomic constraints are derived from: H, phi and the coefficients of friction on tapes
// whose last inputs are the parameters that stay symbols.
//
// Beads on rods keep their masses, gravity and friction as symbols. The formulas of every other system are
// recorded with the values of its parameters, which are constants of the equations.
#pragma once

#include <vector>

#include <pfaff/core/emit/equations.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/facets/taped_constraints.hpp>

namespace pfaff {

struct SymbolicFormulas {
  HolonomicFormulas formulas;
  std::vector<Symbol> parameters;
  std::vector<Real> values;
};

/// The formulas of a model with holonomic constraints; without the coefficients of friction unless they are
/// asked for and there are some.
SymbolicFormulas symbolic_formulas(const Model& model, bool friction);

}  // namespace pfaff
