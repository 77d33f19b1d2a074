// The nonholonomic bracket of a system with constraints A(q, t) v + b(q, t) = 0 of its velocities, from its
// tapes: the pseudo-Poisson tensor of the orthogonal projector in the metric of the kinetic energy,
// g^-1 = H_pp, and what is known of it. Momenta are projected by pbar = p - A^T S^-1 psi(q, p, t), psi = A
// H_p + b, S = A H_pp A^T, and the bracket is the one at pbar.
//
// - Rank: twice that of P, 2(n - m).
// - Casimirs: the constraints psi, and phi where there are holonomic ones. The kernel holds besides, for
// every
//   constraint, the covector (A_alpha, 0), which is no differential of a function unless the constraint is
//   integrable.
// - Flow: Pibar grad H is the motion where b = 0 and nothing depends on time (d'Alembert's principle). With
//   b != 0 the energy is not conserved, which no skew bracket of it could bring about.
// - Jacobi's identity holds where the constraints are integrable. The Jacobiator says how far it is from
// that.
//
// It allocates and is meant for points, not for steps.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <pfaff/brackets/almost_product/almost_product.hpp>
#include <pfaff/brackets/nonholonomic/pseudo_poisson.hpp>
#include <pfaff/core/facets/model.hpp>

namespace pfaff {

class NonholonomicBracket {
 public:
  /// InputError for a model without velocity constraints, and for an H that is not quadratic in p, whose
  /// velocities have no metric.
  explicit NonholonomicBracket(const Model& model);

  /// The number of positions n and of constraints at the level of velocities m.
  [[nodiscard]] std::size_t degrees() const { return degrees_; }
  [[nodiscard]] const std::vector<std::string>& constraint_names() const { return names_; }

  /// P and Q at a place, on velocities. InputError where constraints depend on each other there (which).
  template <class T>
  [[nodiscard]] AlmostProduct<T> projectors(const T& t, const std::vector<T>& q) const;
  /// The momenta pbar of z = (q, p) on the constraints, in place of p.
  template <class T>
  [[nodiscard]] std::vector<T> projected(const T& t, const std::vector<T>& z) const;
  /// Pibar at (q, pbar). T is double, Quad, or a dual over them.
  template <class T>
  [[nodiscard]] Matrix<T> tensor(const T& t, const std::vector<T>& z) const;
  /// The map of a bracket, for residuals.hpp and the matchers.
  template <class T>
  void sharp(const T& t, In<T> z, In<T> covector, Out<T> vector) const {
    const std::vector<T> image =
        tensor<T>(t, {z.begin(), z.end()}) * std::vector<T>(covector.begin(), covector.end());
    for (std::size_t k = 0; k < image.size(); ++k) vector[k] = image[k];
  }

 private:
  template <class T>
  struct Projection;

  std::size_t degrees_ = 0;
  std::vector<std::string> names_;
  std::shared_ptr<const Tape> linear_;  // q -> A (m x n), H_pp (n x n), psi at p = 0 (m)
};

/// The sum {x, {y, z}} + {y, {z, x}} + {z, {x, y}} of three coordinates.
template <class T>
struct Jacobiator {
  T value{};
  std::array<std::size_t, 3> coordinates{};
};

/// What the bracket is at one state.
template <class T>
struct NonholonomicPoint {
  VectorOperator<T> admissible;  // P
  Matrix<T> tensor;              // Pibar, at (q, pbar)
  std::size_t rank = 0;          // of Pibar
  double casimirs = 0;           // the largest |Pibar d psi|, relative to its terms
  double one_forms = 0;          // the largest |Pibar (A_alpha, 0)|, likewise
  Jacobiator<T> jacobiator;      // the largest of all
};
/// Evaluates it at (t, z). T is double or Quad. InputError as of projectors().
template <class T>
NonholonomicPoint<T> nonholonomic_point(const Model& model, const T& t, const std::vector<T>& z);

}  // namespace pfaff
