// The definitions that the files of each dimension instantiate.
#pragma once

#include <pfaff/systems/bead_rod/evaluators.hpp>
#include <pfaff/systems/bead_rod/rod_constraints.hpp>

namespace pfaff::detail {

template <class T, int D>
T potential_energy(const BeadRodParts& parts, In<T> q) {
  return Potentials<T, D>(parts.description, *parts.graph).energy(q);
}

template <class T, int D>
std::unique_ptr<HolonomicConstraints<T>> rod_constraints(const BeadRodParts& parts) {
  return std::make_unique<RodConstraints<T, D>>(parts.description, parts.graph);
}

}  // namespace pfaff::detail
