// Models with velocity constraints on which the claims of formulations and evaluators are measured besides
// the registered systems: between them they have everything that such a model can have.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/facets/model.hpp>

namespace pfaff {

/// Two velocity constraints of five positions with a mass matrix that depends on the positions and linear
/// terms in H. `moving` adds a holonomic constraint, offsets b, and a dependence on time of all of them.
std::shared_ptr<const Model> two_blades(bool moving);

/// All of them, of small dimensions.
std::vector<std::shared_ptr<const Model>> skated_models();

}  // namespace pfaff
