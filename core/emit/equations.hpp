// Equations of motion as one tape with names: what `pfaff derive` makes of a system, and what its emitters
// write as text.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

/// A name that stands in the equations, with its unit ("" where it has none).
struct Symbol {
  std::string name;
  std::string unit;
};

/// Straight-line code for the rates of a system's coordinates.
struct Equations {
  std::string system;  // its name
  std::string method;  // the engine that made them, such as "ldl"
  /// The tape's inputs are the coordinates and then the parameters; its outputs are the rates, one for each
  /// coordinate in their order, and then further quantities such as multipliers.
  Tape tape;
  std::vector<Symbol> coordinates;
  std::vector<Symbol> parameters;            // those kept as symbols; all others are constants of the tape
  std::vector<Real> parameter_values;        // one for each parameter
  std::vector<std::string> further_outputs;  // names of the outputs after the rates
};

}  // namespace pfaff
