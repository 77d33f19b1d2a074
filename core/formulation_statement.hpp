// What a formulation says of itself: its name and reference, along which vectors the reactions of the
// constraints point, what its motion keeps and where, and the form of its friction.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <pfaff/core/facets/holonomic.hpp>

namespace pfaff {

/// What a formulation may claim to keep, each with the scope in which it is tested.
enum class FormulationClaim {
  none,                // an explicit "nothing kept"
  tangent,             // a motion that starts on the surface of the constraints stays on it: phi' = 0 and
                       // phi~' = 0 there; every system
  hidden_constraints,  // phi~' = 0 on and off the surface; systems with holonomic constraints
  constraints,  // phi' = 0 and phi~' = 0 on and off the surface: both are Casimirs of the motion; every
                // system
  energy,       // H' = 0 on and off the surface; systems without friction that do not depend on time
  velocity_constraints,  // psi' = 0 on and off the surface, the rates of holonomic constraints among psi;
                         // systems with velocity constraints
  energy_on_surface,     // H' = 0 on the surface; systems with velocity constraints that do not depend on
                         // time and have no offsets, b = 0
  admissible             // A q' + b = 0 for the velocity q' of the motion, on and off the surface; systems
                         // with velocity constraints
};

constexpr std::string_view to_string(FormulationClaim claim) {
  constexpr std::array<std::string_view, 8> names{"none",
                                                  "tangent",
                                                  "hidden-constraints",
                                                  "constraints",
                                                  "energy",
                                                  "velocity-constraints",
                                                  "energy-on-surface",
                                                  "admissible"};
  return names[static_cast<std::size_t>(claim)];
}

/// The friction of constrained motion, with coefficients Lambda of the momenta. The two forms differ in the
/// reaction of the constraints to it: metriplectic, -Lambda [v - P^T (P Lambda P^T)^-1 P Lambda v], the
/// symmetric Dirac bracket; stokes, -Lambda v + B^T S^-1 P Lambda v, drag with ideal constraint forces.
enum class FrictionForm { metriplectic, stokes, none };

constexpr std::string_view to_string(FrictionForm form) {
  constexpr std::array<std::string_view, 3> names{"metriplectic", "stokes", "none"};
  return names[static_cast<std::size_t>(form)];
}

/// What is said about a formulation.
struct FormulationDescriptor {
  std::string name;           // kebab-case
  std::string title;          // one line
  std::string reference;      // bib key and equations
  std::string description{};  // two to four sentences: what it is, when to take it, where it ends
  Reactions reactions = Reactions::other;
  std::vector<FormulationClaim> keeps{};
};

/// What a formulation says of its right-hand side with given parameters.
struct FormulationStatement {
  Reactions reactions = Reactions::other;
  FrictionForm friction = FrictionForm::none;
  std::vector<FormulationClaim> keeps;
  bool of_an_energy = false;  // the motion is that of a Hamiltonian which the formulation makes
};

}  // namespace pfaff
