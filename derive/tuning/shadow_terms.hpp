// What a splitting does wrong on one system, by its two leading orders.
//
// A splitting of order p of H = T(p) + V(q) is, up to terms of higher order, the flow of the shadow
// Hamiltonian
//
//   H + sum_k h^(d_k - 1) c_k H_k,
//
// where H_k are the Poisson brackets of T and V that belong to the Lyndon words of degree d_k = p + 1 and p +
// 3, and c_k the coordinates of the splitting's logarithm in them (blanes-casas2016;
// splitting_logarithm.hpp). The numbers c_k belong to the method and the functions H_k to the system.
// Brackets that are small on a system, or that cancel each other there, need not be small in the method.
#pragma once

#include <vector>

#include <pfaff/core/facets/model.hpp>
#include <pfaff/derive/tuning/splitting_logarithm.hpp>

namespace pfaff {

/// A quadratic form that measures c_k by what they do on a system.
class ShadowTerms {
 public:
  /// Of splittings with steps of size `step` on an autonomous system with a separable energy, at these
  /// states. The vector fields of the brackets are compared with the system's own; positions and momenta are
  /// each in units of their size over the states.
  ShadowTerms(const Model& model, const SplittingLogarithm& logarithm, double step,
              const std::vector<std::vector<double>>& states);

  /// The root mean square over the states of the vector field of what is added to H, relative to that of H,
  /// for the coordinates c of a logarithm.
  [[nodiscard]] double of(const std::vector<double>& c) const;
  /// R c, upper triangular R, whose length is what of() gives.
  [[nodiscard]] std::vector<double> weighted(const std::vector<double>& c) const;

 private:
  std::size_t size_ = 0;
  std::vector<double> root_;  // R, row-major
};

}  // namespace pfaff
