// Equations of motion of a system as a tape with names, made by one of several methods from its energy and
// its constraints alone: `pfaff derive`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pfaff/bench/studies/derivation_methods.hpp>
#include <pfaff/core/emit/equations.hpp>
#include <pfaff/core/facets/model.hpp>
#include <pfaff/core/formulation_members.hpp>

namespace pfaff {

/// Why a method does not fit a model; empty where it does. InputError for an unknown name.
std::string derivation_misfit(const Model& model, const std::string& method);

/// The largest degree of a generating function that is derived.
inline constexpr int largest_derived_degree = 12;

/// What may be chosen beside the method.
struct DerivationOptions {
  std::optional<FrictionForm> friction{};  // without, the method's own: that of the formulation it derives
  int degree = 4;                          // of method generating-function
  /// Of the methods that eliminate constraint by constraint: the order, by the names that
  /// Model::constraint_names() gives; empty for phi_1, phi~_1, phi_2, phi~_2, ...
  std::vector<std::string> elimination{};
};

/// The equations of a model. InputError for an unknown method, one that does not fit (with those that do),
/// constraints that are dependent whatever the state, and an order of elimination that breaks down (with one
/// that works).
Equations derive(const Model& model, const std::string& method, const DerivationOptions& options = {});
Equations derive(const Model& model, const std::string& method, FrictionForm friction);

/// The equations without parameters that no equation has.
Equations keep_used(Equations equations);

/// The operations of a tape: its instructions but constants, inputs and the time.
std::size_t operations(const Tape& tape);

/// The size of the outputs' expressions as text, in which nothing is shared: the number of operations of the
/// trees below all outputs. A double, because it grows exponentially.
double tree_operations(const Tape& tape);

}  // namespace pfaff
