// How far a state is from the constraints of a model.
#pragma once

#include <algorithm>
#include <vector>

#include <pfaff/runs/support/constraints.hpp>

namespace pfaff::testing {

inline Quad worst_residual(const Model& model, const Quad& t, const std::vector<Quad>& z) {
  std::vector<Quad> residuals;
  ConstraintResiduals<Quad>{model}(t, z, residuals);
  return *std::max_element(residuals.begin(), residuals.end());
}

}  // namespace pfaff::testing
