// Rooted trees and the order conditions of Runge-Kutta methods (hairer-lubich-wanner2006 III.1).
//
// A Runge-Kutta method (a, b) is of order p where for every rooted tree of up to p nodes
//
//   Phi(tree) = sum_i b_i prod_{c child of the root} (a phi(c))_i = 1/gamma(tree),
//   phi(tree)_i = prod_{c child of the root} (a phi(c))_i,   gamma(tree) = |tree| prod_c gamma(c).
//
// There are 1, 1, 2, 4, 9, 20, 48, 115, 286, 719 trees of 1, ..., 10 nodes. The nodes c_i of a method are the
// row sums of a, so that it treats time like a coordinate of the state.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pfaff/integrators/order_conditions/order_condition.hpp>

namespace pfaff {

/// The largest number of nodes of the trees listed.
inline constexpr int largest_tree = 10;

struct RootedTree {
  int order = 1;                      // the number of its nodes
  std::vector<std::size_t> children;  // the trees that remain without the root: places in rooted_trees()
  std::int64_t density = 1;           // gamma
};

/// All rooted trees of up to largest_tree nodes, those with fewer nodes first.
const std::vector<RootedTree>& rooted_trees();

/// "t" for a single node, "[t,[t]]" for a root with a single node and a branch of two.
std::string to_string(const RootedTree& tree);

/// A Runge-Kutta method in the scalar T: a is row-major, s times s.
template <class T>
struct RungeKuttaTableau {
  std::vector<T> a, b;
  [[nodiscard]] std::size_t stages() const { return b.size(); }
};

/// Phi of every tree of up to `order` nodes, in the order of rooted_trees(); exact in rationals.
template <class T>
std::vector<T> elementary_weights(const RungeKuttaTableau<T>& tableau, int order) {
  const std::size_t s = tableau.stages();
  std::vector<std::vector<T>> applied;  // a phi(tree)
  std::vector<T> weights;
  for (const RootedTree& tree : rooted_trees()) {
    if (tree.order > order) break;
    std::vector<T> phi(s, T(1)), next(s, T(0));
    for (const std::size_t child : tree.children)
      for (std::size_t i = 0; i < s; ++i) phi[i] = phi[i] * applied[child][i];
    T weight(0);
    for (std::size_t i = 0; i < s; ++i) {
      weight = weight + tableau.b[i] * phi[i];
      for (std::size_t j = 0; j < s; ++j) next[i] = next[i] + tableau.a[i * s + j] * phi[j];
    }
    weights.push_back(weight);
    applied.push_back(std::move(next));
  }
  return weights;
}

/// The conditions of every tree of up to `order` nodes; `order` is at most largest_tree.
std::vector<OrderCondition> tree_conditions(const RungeKuttaTableau<Quad>& tableau, int order);

/// The theory up to `order` of a method of which b and the entries of a can be chosen: its coefficients are b
/// and then those entries of a, row by row, that enter a condition to first order. The others are left out,
/// as these conditions do not determine them. In an explicit method a is strictly lower triangular.
OrderTheory tree_theory(const RungeKuttaTableau<Quad>& tableau, int order, bool is_explicit);

/// The conditions b_i a_ij + b_j a_ji = b_i b_j, i <= j, by which the method keeps quadratic invariants and
/// constant symplectic structures (hairer-lubich-wanner2006, theorems IV.2.2 and VI.4.3). Their `order` is 0.
std::vector<OrderCondition> symplecticity_conditions(const RungeKuttaTableau<Quad>& tableau);

/// The conditions a_{s+1-i,s+1-j} + a_ij = b_j, by which the method is its own adjoint
/// (hairer-lubich-wanner2006 V.2). Their `order` is 0.
std::vector<OrderCondition> symmetry_conditions(const RungeKuttaTableau<Quad>& tableau);

}  // namespace pfaff
