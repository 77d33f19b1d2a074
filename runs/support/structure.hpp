// The Jacobian of a step, taken through the implicit solve, and how well it preserves the structure of the
// system (symplectic, K-symplectic, Poisson).
#pragma once

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include <pfaff/core/facets/method_instance.hpp>
#include <pfaff/runs/support/congruence.hpp>

namespace pfaff {

/// A step and its Jacobian M_ij = d z'_i / d z_j at one point.
template <class T>
struct StepJacobian {
  Status status = Status::converged;
  std::vector<T> z;         // after the step
  std::vector<T> jacobian;  // row-major
};

/// The Jacobian at z of a map, some columns at a time: map(state) moves a state of dual numbers and says how
/// that ended. The status is the last one that is not `converged`. The map is differentiated by coordinates
/// divided by `units`, powers of two, where these are given: iterations of a step then end when derivatives
/// have converged in these units.
template <class T, class Map>
StepJacobian<T> jacobian_of_map(const std::vector<T>& z, const Map& map, const std::vector<T>& units = {}) {
  const auto unit = [&](std::size_t k) { return units.empty() ? T(1) : units[k]; };
  const std::size_t n = z.size();
  StepJacobian<T> result;
  result.z.resize(n);
  result.jacobian.resize(n * n);
  std::vector<StepDual<T>> dual(n);
  for (std::size_t first = 0; first < n; first += step_directions) {
    const std::size_t count = std::min<std::size_t>(step_directions, n - first);
    for (std::size_t k = 0; k < n; ++k) dual[k] = StepDual<T>(z[k]);
    for (std::size_t k = 0; k < count; ++k) dual[first + k].derivative[k] = unit(first + k);
    if (const Status status = map(dual); status != Status::converged) result.status = status;
    for (std::size_t i = 0; i < n; ++i) {
      result.z[i] = dual[i].value;
      for (std::size_t k = 0; k < count; ++k)
        result.jacobian[i * n + first + k] = dual[i].derivative[k] / unit(first + k);
    }
  }
  return result;
}

/// Differentiates single steps of a method on a model by running them with dual numbers. The derivative is
/// that of the converged step: each evaluation starts without the history of earlier steps, and the implicit
/// solve iterates until its derivative parts have converged too.
template <class T>
class StepDifferentiator {
 public:
  StepDifferentiator(const MethodInstance& method, std::shared_ptr<const Model> model);
  /// By coordinates divided by `units`, where these are given (jacobian_of_map).
  StepJacobian<T> operator()(const T& t, const T& h, const std::vector<T>& z,
                             const std::vector<T>& units = {});

 private:
  std::unique_ptr<Stepper<StepDual<T>>> stepper_;
};

/// The name, as in claims and reports, of the structure that the exact motion of a model preserves and
/// KeptStructure measures: constrained-symplectic for holonomic constraints, K-symplectic for a structure
/// K(z, t), symplectic for the canonical one, poisson where there is only a Poisson tensor; empty where there
/// is none.
std::string_view structure_name(const Model& model);

/// Measures how far a differentiated step (z, t) -> (z', t') with Jacobian M is from preserving the model's
/// structure. The residual is M^T K(z', t') M - K(z, t) for a structure K, and M Pi(z, t) M^T - Pi(z', t')
/// for systems with a Poisson tensor only. With holonomic constraints it is M^T J M - J on vectors tangent to
/// the surface phi = 0, phi~ = 0, on which z has to lie.
template <class T>
class KeptStructure {
 public:
  explicit KeptStructure(std::shared_ptr<const Model> model);
  /// True when the model has a structure to keep.
  [[nodiscard]] static bool applies(const Model& model);
  /// The largest entry of the residual, divided by the largest entry of |M|^T |K| |M|, for the step of size h
  /// from z at time t. It is at round-off for a structure-preserving step, and NaN where the step has failed.
  /// With `units`, one size for each coordinate, all matrices are taken in coordinates divided by them, so
  /// that the residual does not depend on the units in which the system is written.
  T operator()(const StepJacobian<T>& step, const T& t, const T& h, const std::vector<T>& z,
               const std::vector<T>& units = {});
  /// The congruence that a step keeping the structure satisfies, for a step that has converged.
  Congruence<T> congruence(const StepJacobian<T>& step, const T& t, const T& h, const std::vector<T>& z,
                           const std::vector<T>& units = {});

 private:
  Problem<T> problem_;
  bool poisson_, constrained_;
};

/// Takes a step, differentiates it and measures how well it preserves the structure. The residual is that of
/// KeptStructure, in coordinates whose units make the sizes of its terms alike (equilibrating_units), so that
/// neither units nor light bodies hide what a step loses; and in the system's own coordinates where it is
/// only the rounding of the step there.
template <class T>
class StructureResidual {
 public:
  StructureResidual(const MethodInstance& method, const std::shared_ptr<const Model>& model)
      : differentiate_(method, model), kept_(model) {}
  [[nodiscard]] static bool applies(const Model& model) { return KeptStructure<T>::applies(model); }
  /// Of the step of size h from z at time t; NaN where it has failed.
  T operator()(const T& t, const T& h, const std::vector<T>& z);

 private:
  StepDifferentiator<T> differentiate_;
  KeptStructure<T> kept_;
};

/// The projection onto the tangent space at (t, z) of the surface phi = 0, phi~ = 0 of a model with holonomic
/// constraints, as an n x n row-major matrix. Normal components are removed from positions along H_pp B^T and
/// from momenta along B^T. Singular constraints give NaN.
template <class T>
std::vector<T> tangent_projection(const Model& model, const T& t, const std::vector<T>& z);

}  // namespace pfaff
