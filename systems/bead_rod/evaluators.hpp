// Bead-rod formulas in one dimension D of space; every D is compiled in a file of its own.
#pragma once

#include <pfaff/systems/bead_rod/system.hpp>

namespace pfaff::detail {

template <class T, int D>
T potential_energy(const BeadRodParts& parts, In<T> q);
template <class T, int D>
std::unique_ptr<HolonomicConstraints<T>> rod_constraints(const BeadRodParts& parts);

}  // namespace pfaff::detail

#define PFAFF_FOR_EVERY_SCALAR(USE) \
  USE(double)                       \
  USE(pfaff::Quad) USE(pfaff::StepDual<double>) USE(pfaff::StepDual<pfaff::Quad>) USE(pfaff::Recorded)
