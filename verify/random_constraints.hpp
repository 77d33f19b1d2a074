// Random systems with constraints, on which the claims of formulations are measured besides the registered
// ones, since they have to hold for every system of constraints.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// A connected graph of rods in space, drawn once with a fixed seed, with a loop, gravity, and friction of
/// some of its beads.
std::shared_ptr<const Model> random_rods();

/// Polynomial systems drawn with fixed seeds: surfaces, surfaces of revolution, rods on a plane, second-class
/// constraints of the phase space and velocity constraints, two of each, and the same surfaces, rods and
/// second-class constraints with terms that depend on time; those that are canonical also with applied
/// forces.
std::vector<std::shared_ptr<const Model>> random_constraints();

}  // namespace pfaff
