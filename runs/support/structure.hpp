// The Jacobian of a step, taken through the implicit solve, and how well it preserves the structure of the
// system (symplectic, K-symplectic, Poisson).
#pragma once

#include <algorithm>
#include <memory>
#include <string_view>
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

/// The Jacobian at z of a map, some columns at a time: map(state) moves a state of dual numbers and says how
/// that ended. The status is the last one that is not `converged`.
template <class T, class Map>
StepJacobian<T> jacobian_of_map(const std::vector<T>& z, const Map& map) {
  const std::size_t n = z.size();
  StepJacobian<T> result;
  result.z.resize(n);
  result.jacobian.resize(n * n);
  std::vector<StepDual<T>> dual(n);
  for (std::size_t first = 0; first < n; first += step_directions) {
    const std::size_t count = std::min<std::size_t>(step_directions, n - first);
    for (std::size_t k = 0; k < n; ++k) dual[k] = StepDual<T>(z[k]);
    for (std::size_t k = 0; k < count; ++k) dual[first + k].derivative[k] = T(1);
    if (const Status status = map(dual); status != Status::converged) result.status = status;
    for (std::size_t i = 0; i < n; ++i) {
      result.z[i] = dual[i].value;
      for (std::size_t k = 0; k < count; ++k) result.jacobian[i * n + first + k] = dual[i].derivative[k];
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
  StepJacobian<T> operator()(const T& t, const T& h, const std::vector<T>& z);

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

 private:
  Problem<T> problem_;
  bool poisson_, constrained_;
};

/// Takes a step, differentiates it and measures how well it preserves the structure.
template <class T>
class StructureResidual {
 public:
  StructureResidual(const MethodInstance& method, const std::shared_ptr<const Model>& model)
      : differentiate_(method, model), kept_(model) {}
  [[nodiscard]] static bool applies(const Model& model) { return KeptStructure<T>::applies(model); }
  /// The residual that KeptStructure defines, of the step of size h from z at time t.
  T operator()(const T& t, const T& h, const std::vector<T>& z) {
    return kept_(differentiate_(t, h, z), t, h, z);
  }

 private:
  StepDifferentiator<T> differentiate_;
  KeptStructure<T> kept_;
};

/// The projection onto the tangent space at (t, z) of the surface phi = 0, phi~ = 0 of a model with holonomic
/// constraints, as an n x n row-major matrix. Normal components are removed from positions along H_pp B^T and
/// from momenta along B^T. Singular constraints give NaN.
template <class T>
std::vector<T> tangent_projection(const Model& model, const T& t, const std::vector<T>& z);

/// The matrix in coordinates divided by `units`: a_ij u_i^row u_j^column. A Jacobian has the exponents -1 and
/// 1, a two-form 1 and 1, a Poisson tensor -1 and -1. Without units the matrix is returned as it is.
template <class T>
std::vector<T> in_units(std::vector<T> a, const std::vector<T>& units, int row, int column) {
  const std::size_t n = units.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      T& x = a[i * n + j];
      x = row > 0 ? T(x * units[i]) : T(x / units[i]);
      x = column > 0 ? T(x * units[j]) : T(x / units[j]);
    }
  return a;
}

/// The relative residual of KeptStructure for given matrices: max |M^T K1 M - K0| / max |M|^T |K1| |M|, all n
/// x n row-major. Where the largest numbers in the rows of |M|^T |K1| |M| differ by much, coordinates are
/// taken in units in which they are alike: what small coordinates lose does not hide behind large ones.
template <class T>
T congruence_residual(const std::vector<T>& m, const std::vector<T>& k1, const std::vector<T>& k0);

}  // namespace pfaff
