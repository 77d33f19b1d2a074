// The quantities that a run follows of a text model without being told: the energy and the Casimirs.
#pragma once

#include <pfaff/core/facets/model.hpp>

namespace pfaff::text {

/// Leaves out offsets of velocity constraints that are zero, as if they had not been written: methods for
/// constraints A v = 0 take the model.
void leave_out_zero_offsets(ModelSource& source);

/// Adds the energy to the invariants of a model that has a Hamiltonian without the time in it, as `energy`,
/// and the Casimirs that its bracket states, as `casimir1`, `casimir2`, ... Each is left out where an
/// invariant of the author has that name, or is a function of it: their gradients are parallel at two states.
/// The energy is conserved where nothing takes from it: no damping, friction or applied force but zero, no
/// symmetric bracket that acts on it, no constraint that moves; otherwise nothing is claimed of it.
void add_followed_quantities(ModelSource& source);

}  // namespace pfaff::text
