// On which model of a system a claim of a method is judged, and the checks of methods on random systems.
#pragma once

#include <pfaff/verify/check.hpp>
#include <pfaff/verify/random_systems/recipe.hpp>

namespace pfaff {

/// The model that a method runs on, which a formulation makes where the method needs a motion; null where
/// none fits or the claim does not speak of it.
std::shared_ptr<const Model> model_in_scope(const MethodInstance& method, Claim claim,
                                            const std::shared_ptr<const Model>& model);
/// The same, and null too where the method does not make the claim on that model.
std::shared_ptr<const Model> model_claimed_on(const MethodInstance& method, Claim claim,
                                              const std::shared_ptr<const Model>& model);

/// All checks of a method on random systems with a fixed seed, of three kinds in the scope of each of its
/// claims, or as many as there are; none for a method that claims nothing. A quick verification of a method
/// with many parameters numbers these by `turn`, from 0; after the first, each claim is checked on one kind,
/// another one from turn to turn. With `every_kind` each claim is checked on all kinds in its scope.
std::vector<Check> check_on_random_systems(const MethodInstance& method, const Assignments& parameters,
                                           std::size_t turn = 0, bool every_kind = false);

}  // namespace pfaff
