// Finds T and V in an energy that was recorded as one formula.
//
// H(q, p, t) is followed from its value backwards through sums, differences, and products and quotients with
// constants and functions of time: where every term that is reached in this way reads positions alone or
// momenta alone, H = T(p, t) + V(q, t), and terms that read neither belong to V. Products such as (q + p)^2
// are not expanded: an energy that is a sum only after that is not found to be one.
#pragma once

#include <memory>
#include <optional>

#include <pfaff/core/tape/tape.hpp>

namespace pfaff::python {

struct SeparableEnergy {
  std::shared_ptr<const Tape> kinetic, potential;  // of half of the coordinates each, and of the parameters
};

/// The two parts of an energy of (q, p), `dimension` numbers, behind which there may be parameters; nullopt
/// where the tape shows no sum.
std::optional<SeparableEnergy> separable_energy(const Tape& hamiltonian, int dimension);

}  // namespace pfaff::python
