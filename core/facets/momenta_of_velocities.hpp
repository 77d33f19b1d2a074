// The momenta of a canonical system of which positions and velocities are known.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff {

class Model;

/// The energy of which the velocity is the slope by the momenta: a tape of (q, p), or of p alone where it is
/// the kinetic energy. Null where momenta do not follow from velocities: where the coordinates are not
/// canonical, and where constraints of the phase space or a second bracket take part in the velocities.
std::shared_ptr<const Tape> energy_of_velocities(const Model& model);

/// The momenta at which H_p = v at a time, by Newton's method in quad from p = 0. `energy` is a tape of (q,
/// p), or of p alone. InputError where none are found.
std::vector<Real> momenta_of_velocities(const std::shared_ptr<const Tape>& energy, const Real& t,
                                        const std::vector<Real>& q, const std::vector<Real>& v);

}  // namespace pfaff
