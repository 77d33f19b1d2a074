// Holonomic constraints that follow from the others, such as the fifth of five equal parallel cranks, or the
// sixth rod between four points of a plane. The matrix S = B M^-1 B^T of all constraints is then singular
// everywhere on their surface, although there is a motion: only how the reactions are shared is not
// determined, and of all multipliers that give these reactions none is distinguished by the motion.
#pragma once

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// Leaves the holonomic constraints out of `source` that follow from the others, so that those that are left
/// are independent, and follows each of them as a conserved quantity of its name instead; their names are
/// then in `source.redundant_constraints`. A constraint follows from others where its gradient depends on
/// theirs in the initial state and it is zero, to the round-off of quad precision, wherever the others are
/// near that state. Nothing is changed where gradients are dependent in the initial state alone (a singular
/// position), nor where the constraints are an author's compiled code.
void leave_out_redundant(ModelSource& source);

}  // namespace pfaff
