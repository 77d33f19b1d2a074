// Bead-rod formulas in one dimension D of space; every D is compiled in a file of its own.
#pragma once

#include <pfaff/systems/bead_rod/system.hpp>

namespace pfaff::detail {

template <class T, int D>
std::unique_ptr<PotentialEnergy<T>> potential_energy(const BeadRodParts& parts);
template <class T, int D>
std::unique_ptr<HolonomicConstraints<T>> rod_constraints(const BeadRodParts& parts);

}  // namespace pfaff::detail
