// parts = "kepler": the bodies of a text model, read off its energies, for the splitting into Kepler orbits
// and their interaction.
#pragma once

#include <vector>

#include <pfaff/core/tape/tape.hpp>
#include <pfaff/systems/canonical/planetary_flows.hpp>

namespace pfaff::text {

/// The bodies whose energies these are, T = sum_i |p_i|^2/(2 m_i) and V = -G sum_(j < i) m_i m_j/|q_i - q_j|,
/// in a plane or in space, with coordinates by direction. `initial` is a state, or empty, and says of which
/// size positions are. InputError, with the name of the energy that is none of these.
PlanetaryBodies attracting_bodies(const Tape& kinetic, const Tape& potential,
                                  const std::vector<Real>& initial);

}  // namespace pfaff::text
