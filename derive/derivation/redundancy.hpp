// Constraints of which equations of motion cannot be derived, because a pivot of the elimination vanishes
// whatever the state.
#pragma once

#include <memory>

#include <pfaff/derive/derivation/symbolic_formulas.hpp>

namespace pfaff {

/// InputError, naming a constraint, where S is singular at a generic point: the constraint then follows from
/// others wherever the system is. With `recursion` also where S^D is, which the recursion divides by.
void refuse_redundant(const std::shared_ptr<const HolonomicTapes>& tapes, const SymbolicFormulas& source,
                      const Model& model, bool recursion);

}  // namespace pfaff
