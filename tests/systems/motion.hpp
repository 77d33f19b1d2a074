// The model that moves for a system: the system itself, or, where it has constraints, its motion in Dirac's
// formulation.
#pragma once

#include <pfaff/core/formulation.hpp>

namespace pfaff::testing {

inline std::shared_ptr<const Model> motion_of(const std::shared_ptr<const Model>& model,
                                              const char* formulation = "dirac",
                                              const Assignments& set = {}) {
  if (!model->constrained()) return model;
  return formulations().get(formulation, "formulation").apply(model, set);
}

}  // namespace pfaff::testing
