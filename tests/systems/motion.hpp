// The model that moves for a system: the system itself, or, where it has constraints, its motion in Dirac's
// formulation, and in the nonholonomic one for constraints of velocities. And states on such constraints.
#pragma once

#include <gtest/gtest.h>

#include <pfaff/bench/measure/constraints.hpp>
#include <pfaff/core/formulation.hpp>
#include <pfaff/core/system.hpp>

namespace pfaff::testing {

inline std::shared_ptr<const Model> motion_of(const std::shared_ptr<const Model>& model,
                                              const char* formulation = "dirac",
                                              const Assignments& set = {}) {
  if (!model->restricted() || model->moves()) return model;
  return formulations()
      .get(model->nonholonomic() ? "nonholonomic" : formulation, "formulation")
      .apply(model, set);
}

/// The state with its momenta moved onto the velocity constraints, of which there may be none.
inline std::vector<Quad> on_velocity_constraints(const SystemPlugin& plugin, const Assignments& parameters,
                                                 std::vector<Quad> z, Quad t = Quad(0)) {
  const auto model = plugin.make(parameters);
  if (!model->nonholonomic()) return z;
  for (int pass = 0; pass < 2; ++pass)
    EXPECT_EQ(project_onto_constraints(*model, t, z).status, Status::converged) << plugin.name();
  return z;
}

}  // namespace pfaff::testing
