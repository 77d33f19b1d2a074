// What tests of generating functions measure: sizes of matrices, the structure at a point and what a step
// leaves of it.
#pragma once

#include <cmath>

#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/runs/support/structure.hpp>

#include "../formula_values.hpp"

namespace pfaff::testing {

/// Some hundred roundings of numbers about 1, in quad.
inline constexpr double at_round_off = 1e-30;

inline const Quad start_time = Quad(7) / Quad(10);

/// The largest entry; infinite where one is not finite.
template <class T>
double size_of(const Matrix<T>& m) {
  const auto value = static_cast<double>(largest(m));
  return std::isfinite(value) ? value : INFINITY;
}
template <class T>
double size_of(const std::vector<T>& x) {
  return distance(x, std::vector<T>(x.size()));
}
template <class T>
double distance(const Matrix<T>& a, const Matrix<T>& b) {
  return size_of(a - b);
}
template <class T>
double asymmetry(const Matrix<T>& m) {
  return distance(m, m.transposed());
}

inline Matrix<Quad> structure_at(const Model& model, Quad t, const Numbers& z) {
  return {z.size(), values(model, Formula::structure, t, z)};
}
/// |M^T K M - K0| of a step of 1/10 from the initial state at 7/10.
template <class T>
double structure_residual(const MethodInstance& method, const std::shared_ptr<const Model>& model) {
  return static_cast<double>(StructureResidual<T>(method, model)(
      T(Real::fraction(7, 10)), T(Real::fraction(1, 10)), initial_state<T>(*model)));
}

}  // namespace pfaff::testing
