// The state at which a run starts: all its coordinates, or positions and velocities, to which momenta belong.
#pragma once

#include <string>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// A state as it is asked for: numbers or expressions as texts. Beside velocities the coordinates are
/// positions alone. What is empty is the system's own.
struct AskedState {
  std::vector<std::string> coordinates, velocities;
};

/// One finite number for each coordinate of the model; InputError, naming `what` ("initial"), otherwise.
std::vector<Real> state_numbers(const Model& model, const std::vector<std::string>& texts,
                                const std::string& what);

/// The state that is asked for, at the time t. InputError where it has not the size of the model's states,
/// and where velocities are given to a system whose momenta do not follow from them.
std::vector<Real> initial_state(const Model& model, const AskedState& asked, const Real& t);

}  // namespace pfaff
