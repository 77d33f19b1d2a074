// The Jacobian of a step, implicit solve included, and what it does to the structure.
#pragma once

#include <memory>
#include <vector>

#include <pfaff/core/integrator.hpp>

namespace pfaff {

/// A step and its Jacobian M_ij = d z'_i / d z_j at one point.
template <class T>
struct StepJacobian {
  Status status = Status::converged;
  std::vector<T> z;         // after the step
  std::vector<T> jacobian;  // row-major
};

/// Differentiates single steps of a method on a model. The derivative is that of the converged step: each
/// evaluation starts without history, and the implicit solve converges in its derivative parts too.
template <class T>
class StepDifferentiator {
 public:
  StepDifferentiator(const MethodInstance& method, std::shared_ptr<const Model> model);
  StepJacobian<T> operator()(const T& t, const T& h, const std::vector<T>& z);

 private:
  std::unique_ptr<Stepper<StepDual<T>>> stepper_;
};

/// Measures M^T K(z', t') M - K(z, t), or M Pi(z, t) M^T - Pi(z', t') for systems with a Poisson tensor only.
/// With holonomic constraints, M^T J M - J on vectors tangent to the surface of both levels of constraints,
/// on which z has to be.
template <class T>
class StructureResidual {
 public:
  StructureResidual(const MethodInstance& method, std::shared_ptr<const Model> model);
  /// True when the model has a structure to keep.
  [[nodiscard]] static bool applies(const Model& model);
  /// The largest entry of the residual over the largest entry of |M|^T |K| |M|: round-off for a
  /// structure-preserving step. NaN when the step fails.
  T operator()(const T& t, const T& h, const std::vector<T>& z);

 private:
  StepDifferentiator<T> differentiate_;
  Problem<T> problem_;
  bool poisson_, constrained_;
};

/// The projection onto the tangent space at (t, z) of the surface phi = 0, phi~ = 0 of a model with holonomic
/// constraints: positions along H_pp B^T, momenta along B^T; n x n row-major. Singular constraints give NaN.
template <class T>
std::vector<T> tangent_projection(const Model& model, const T& t, const std::vector<T>& z);

/// The same for a given Jacobian: max |M^T K1 M - K0| / max |M|^T |K1| |M|, all n x n row-major.
template <class T>
T congruence_residual(const std::vector<T>& m, const std::vector<T>& k1, const std::vector<T>& k0);

}  // namespace pfaff
