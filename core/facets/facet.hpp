// The facets: what a system may offer and what a method may need. This list is the only one.
//
// It drives the members of Problem, the concepts that methods are constrained by, the needs that the registry
// finds out, and the message when a pairing does not fit.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace pfaff {

enum class Facet : unsigned {
  vector_field,    // dz/dt = X(z, t)
  hamiltonian,     // an energy and the bracket that makes X of it
  separable,       // canonical, H = T(p) + V(q, t)
  conformal,       // q' = T_p(p), p' = -V_q(q, t) - nu p: the canonical structure times e^{nu t} is kept
  structure,       // K(z, t) zdot + D(z, t) = 0, self-adjoint: K skew and closed, d_t K = D_z - D_z^T
  birkhoffian,     // that of the action of F(z, t).dz - B(z, t) dt: K = dF, D = -(grad B + F_t)
  darboux_chart,   // coordinates y in which the structure is constant and canonical
  generating_map,  // alpha of pairs of states, through which generating functions make maps
  holonomic,       // canonical, with constraints phi(q, t) = 0 (core/facets/holonomic.hpp)
  constraints,     // an energy and a bracket, with constraints phi(z, t) = 0 that are second class
  metriplectic,    // an energy with two brackets, Poisson's and a symmetric one; an entropy or none
  invariants,      // named quantities with their expected behaviour
  exact_solution,  // the flow in closed form
  count
};

constexpr std::string_view to_string(Facet facet) {
  constexpr std::array<std::string_view, static_cast<std::size_t>(Facet::count)> names{
      "vector-field", "hamiltonian",   "separable",      "conformal", "structure",
      "birkhoffian",  "darboux-chart", "generating-map", "holonomic", "constraints",
      "metriplectic", "invariants",    "exact-solution"};
  return names[static_cast<std::size_t>(facet)];
}

/// A set of facets; usable as a template argument.
struct FacetSet {
  unsigned bits = 0;

  static constexpr FacetSet all() { return {(1U << static_cast<unsigned>(Facet::count)) - 1U}; }
  [[nodiscard]] constexpr bool has(Facet f) const { return (bits >> static_cast<unsigned>(f) & 1U) != 0; }
  [[nodiscard]] constexpr FacetSet with(Facet f) const { return {bits | 1U << static_cast<unsigned>(f)}; }
  [[nodiscard]] constexpr FacetSet without(Facet f) const {
    return {bits & ~(1U << static_cast<unsigned>(f))};
  }
  [[nodiscard]] constexpr bool includes(FacetSet other) const { return (bits & other.bits) == other.bits; }
  friend constexpr bool operator==(FacetSet, FacetSet) = default;
};

/// The facets' names joined by ", ".
std::string to_string(FacetSet set);

/// The formulas behind the facets. Each is a map (t, arguments) -> results.
enum class Formula : unsigned {
  field,                 // n -> n
  field_jacobian,        // n -> n x n
  hamiltonian,           // n -> 1
  hamiltonian_gradient,  // n -> n
  poisson_tensor,        // n -> n x n
  kinetic,               // p: n/2 -> 1
  potential,             // q: n/2 -> 1
  force,                 // q: n/2 -> n/2, minus the potential's gradient
  velocity,              // p: n/2 -> n/2, the kinetic energy's gradient
  birkhoffian,           // n -> 1
  one_form,              // n -> n
  structure,             // n -> n x n, K_ij = d_i F_j - d_j F_i
  covector,              // n -> n, D = -(grad B + F_t)
  chart,                 // n -> n, y = chart(t, z)
  chart_inverse,         // n -> n
  chart_hamiltonian,     // n -> 1, of y
  chart_field,           // n -> n, of y
  chart_field_jacobian,  // n -> n x n
  alpha,                 // time t; (new state, old state, t0): 2n + 1 -> (w^, w): 2n
  holonomic,             // q: n/2 -> number of constraints
  friction,              // n -> n/2, coefficients lambda >= 0 of the momenta
  constraints,           // n -> number of constraints, all of them: with hidden ones where holonomic
  constraint_gradients,  // n -> number of constraints x n
  symmetric_tensor,      // n -> n x n, the symmetric bracket of a metriplectic system
  entropy,               // n -> 1
  invariants,            // n -> number of invariants
  exact_solution,        // time elapsed; (initial state, initial time): n + 1 -> n
  count
};

constexpr std::size_t formula_count = static_cast<std::size_t>(Formula::count);
constexpr std::size_t index(Formula formula) { return static_cast<std::size_t>(formula); }

}  // namespace pfaff
