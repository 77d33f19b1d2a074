// Models whose formulas are compiled by the system's compiler.
//
// The tapes of a model are written as C++ (core/emit/), compiled and loaded, so that a system that was given
// as text, or whose formulas are derived, runs as fast as one whose formulas its author compiled. The
// operations and their order are those of the tape: results differ by no more than roundings of the library's
// functions. Only doubles are compiled; all other numbers go on replaying the tapes.
#pragma once

#include <memory>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// The model with compiled formulas: field, force, velocity, chart and what follows from them by
/// differentiation, energies, structures and invariants, as far as it has them and they are not compiled
/// already, the series of the field in the chart, and the field that a formulation makes of constraints, for
/// systems of up to 400 coordinates. Constraints themselves are left as they are. Where the machine has no
/// compiler this is the model itself, which is said once on stderr. RunError where the compiler fails.
std::shared_ptr<const Model> compiled(const std::shared_ptr<const Model>& model);

/// The code of one tape for doubles, called with nothing for a system; without a call where the machine has
/// no compiler, which is said as above, and where the tape is longer than 200000 operations. RunError, naming
/// `what`, where the compiler fails.
struct CompiledTape {
  CompiledFormula call = nullptr;
  std::shared_ptr<const void> library{};  // that holds it
};
CompiledTape compiled(const Tape& tape, const std::string& what);

/// The C++ text of what `compiled` compiles; empty where there is nothing.
std::string native_text(const Model& model);

}  // namespace pfaff
