// The momenta of a canonical text model whose initial state is given by positions and velocities.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff::text {

/// p = L_v(q, v) at the time zero, for a Lagrangian, a tape of (q, v); exact where the numbers stay
/// fractions.
std::vector<Real> momenta_of_lagrangian(const Tape& lagrangian, const std::vector<Real>& q,
                                        const std::vector<Real>& v);

/// The momenta at which H_p = v at the time zero, by Newton's method in quad from p = 0. `energy` is a tape
/// of (q, p), or of p alone. InputError where none are found.
std::vector<Real> momenta_of_energy(const std::shared_ptr<const Tape>& energy, const std::vector<Real>& q,
                                    const std::vector<Real>& v);

}  // namespace pfaff::text
