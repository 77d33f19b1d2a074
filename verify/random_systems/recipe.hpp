// Recipes of random systems: a kind of system and the few polynomials and numbers that fix one of it.
//
// What holds for every system of a kind (a chart is Darboux's, an invariant is kept, the state is on the
// constraints) holds by the way in which the formulas are made of the recipe. A term of a recipe may
// therefore be left out or changed, and what is made of the rest is still a system of that kind.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <pfaff/verify/random_systems/polynomial_system.hpp>

namespace pfaff {

/// The kinds of random systems, from simple to composed. d is the number of positions.
enum class SystemKind {
  separable,             // H = T(p) + V(q)
  driven,                // H = T(p) + V(q, t)
  nonseparable,          // H(q, p)
  damped,                // T and V with friction, q' = T_p, p' = -V_q - nu p
  central,               // T(|p|^2/2) + V(|q|^2/2), which keeps the angular momentum
  central_nonseparable,  // H(|q|^2/2, |p|^2/2, q.p), which keeps it too
  scaled_form,           // p dq - H dt pulled back through y = (q, s(q, t) p + f(q, t)), plus a gauge; d = 1
  sheared_form,          // the same through shears p_i += f_i(q, t), q_i += g_i(p, t)
  casimir_bracket,       // {f, g} = grad C.(grad f x grad g) in space, with the Casimir C
  metriplectic,          // the same with the entropy S = C and G = alpha (|H_z|^2 I - H_z H_z^T)
  field,                 // any polynomial field
  skew_field,            // z' = A(z) z with A skew, which keeps |z|^2
  surface,               // T = |p|^2/(2 m), V(q), constraints psi(q) = psi(q0)
  revolution,            // a particle in space, everything symmetric about the third axis
  rods,                  // beads on a plane and rods between them, or to the origin
  second_class,          // q_d + f = const and p_d + g = const, f and g functions of the other variables
  rolling,               // velocity constraints A(q) v = 0
  transcendental,        // T(p) + V(q), polynomials of p and q and of functions of single components
  breathing,             // H = T(p, t) + V(q, t)
  breathing_surface,     // a surface with T = (1 + r t) |p|^2/(2 m)
  concave_metriplectic   // metriplectic with the entropy S = -C
};
/// In the order in which verification chooses among those that fit: the first, one in the middle, the last.
inline constexpr std::array system_kinds{SystemKind::separable,
                                         SystemKind::driven,
                                         SystemKind::breathing,
                                         SystemKind::nonseparable,
                                         SystemKind::damped,
                                         SystemKind::central,
                                         SystemKind::central_nonseparable,
                                         SystemKind::scaled_form,
                                         SystemKind::sheared_form,
                                         SystemKind::casimir_bracket,
                                         SystemKind::metriplectic,
                                         SystemKind::concave_metriplectic,
                                         SystemKind::field,
                                         SystemKind::skew_field,
                                         SystemKind::surface,
                                         SystemKind::revolution,
                                         SystemKind::breathing_surface,
                                         SystemKind::rods,
                                         SystemKind::second_class,
                                         SystemKind::rolling,
                                         SystemKind::transcendental};
/// "separable", "second-class", ...
std::string_view to_string(SystemKind kind);

struct Recipe {
  SystemKind kind = SystemKind::separable;
  std::size_t dimension = 2;  // of the state
  /// What the kind is made of, in the order that the comment "Parts" says above the kind's function in its
  /// `*_recipes.cpp`; polynomials in variables of their own, such as positions, momenta, all of them, or
  /// invariants.
  std::vector<std::vector<SparsePolynomial>> parts;
  /// The state at which claims are measured. With constraints, momenta here are what the velocities would be
  /// without them, and are made tangent.
  std::vector<Real> state;
  std::vector<Real> masses;  // of positions, or of beads, where constraints restrict them
  /// Of the variables of each part, those that stand in its polynomials behind them; of kind transcendental.
  std::vector<std::vector<AppliedFunction>> applied;
  Real rate;  // of friction or of a growing kinetic energy, or the strength of a relaxation
  std::vector<std::pair<std::size_t, std::size_t>> rods;  // between beads; the last index is the origin
};

/// The formulas of a recipe.
PolynomialSystem system_of(const Recipe& recipe);

/// A random recipe, a function of kind, seed and `size`: 0 gives few terms and variables, 2 many.
Recipe random_recipe(SystemKind kind, std::uint64_t seed, int size);
/// The size with which claims and identities are verified.
inline constexpr int verified_size = 1;

/// Recipes that are simpler than this one in one respect: parts of their terms, fewer variables, constraints
/// and rods, lower powers, and simpler numbers. Those that leave out most stand first.
std::vector<Recipe> simpler(const Recipe& recipe);

/// What makes one recipe simpler than another: dimension, terms, powers and the lengths of its numbers,
/// compared in this order. simpler() gives recipes of less complexity only.
std::array<std::size_t, 4> complexity(const Recipe& recipe);

namespace detail {

// The kinds by family, each in a file of its own.
PolynomialSystem canonical_system(const Recipe& recipe);
PolynomialSystem central_system(const Recipe& recipe);
PolynomialSystem transcendental_system(const Recipe& recipe);
PolynomialSystem birkhoffian_system(const Recipe& recipe);
PolynomialSystem bracket_system(const Recipe& recipe);
PolynomialSystem field_system(const Recipe& recipe);
PolynomialSystem constrained_system(const Recipe& recipe);

/// p in the variables first ... of so many, in place of its own first ones.
SparsePolynomial moved(const SparsePolynomial& p, std::size_t variables, std::size_t first);
/// |x|^2/2 of the variables first ... first + count - 1 of so many.
SparsePolynomial half_square(std::size_t variables, std::size_t first, std::size_t count);
/// Adds an invariant to a system's list.
void keep(PolynomialSystem& system, const char* name, const SparsePolynomial& invariant);

}  // namespace detail

}  // namespace pfaff
