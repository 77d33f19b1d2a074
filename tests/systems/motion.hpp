// The motion of a model, and states on constraints of velocities.
#pragma once

#include <gtest/gtest.h>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/motion.hpp>
#include <pfaff/runs/support/constraints.hpp>

namespace pfaff::testing {

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
