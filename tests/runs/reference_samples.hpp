// Models made of a vector field and an initial state, for tests of reference solutions.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/system.hpp>
#include <pfaff/runs/support/reference.hpp>

namespace pfaff::testing {

template <class S>
std::shared_ptr<const Model> sample_motion(S system, std::vector<Real> initial) {
  return make_model({.name = "sample", .title = "", .reference = "", .initial = std::move(initial)}, system);
}
inline std::vector<Quad> start_of_sample(const Model& model) {
  std::vector<Quad> z;
  for (const Real& x : model.initial()) z.push_back(x.quad());
  return z;
}

}  // namespace pfaff::testing
