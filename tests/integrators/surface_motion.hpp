// What a method makes of a motion on constraints, and how far from them it gets.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include <pfaff/core/tape/replay.hpp>
#include <pfaff/runs/motion.hpp>

#include "methods.hpp"

namespace pfaff::testing {

template <class T>
struct SurfaceMotion {
  std::vector<T> z;  // at the end
  Status status = Status::converged;
  T off_surface{0};  // the largest |phi| after a step
  std::int64_t iterations = 0;
};

/// So many steps of the size h from the model's own state, or those before one that does not converge.
template <class T>
SurfaceMotion<T> surface_motion(const char* method, const std::shared_ptr<const Model>& model, const T& h,
                                int steps) {
  const auto instance = method_named(method);
  Integration<T> run(
      start_with<T>(*instance, motion_for(*instance, model), initial_state<T>(*model), h, T(0)));
  SurfaceMotion<T> result;
  Replay<T> constraints(model->tape(Formula::holonomic));
  std::vector<T> phi(constraints.tape().outputs.size());
  for (int step = 0; step < steps && result.status == Status::converged; ++step) {
    result.status = run.steps(1).status();
    constraints(run.time(), run.state().data(), phi.data());
    for (const T& x : phi) result.off_surface = std::max(result.off_surface, T(abs(x)));
  }
  result.z.assign(run.state().begin(), run.state().end());
  result.iterations = run.counters().iterations;
  return result;
}

}  // namespace pfaff::testing
