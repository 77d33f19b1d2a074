// One random system tried on one claim.
#pragma once

#include <optional>

#include <pfaff/verify/falsification/falsify.hpp>

namespace pfaff {

/// The model as the method runs on it; null where the claim does not speak of it or, for claims that the
/// method is said to make, where it does not make it there.
std::shared_ptr<const Model> model_under_test(const ClaimUnderTest& test,
                                              const std::shared_ptr<const Model>& model);

/// Judges the claim on the system of the recipe, from its initial state, at the time and with the steps of
/// `at`; the model and the state of `at` are not used. nullopt where the claim holds or does not speak of the
/// system.
std::optional<Counterexample> counterexample_in(const ClaimUnderTest& test, const Recipe& recipe,
                                                const JudgedStep& at);

/// The counterexample without formulas that neither the method nor the claim asks for: invariants, a
/// reversal, Casimirs, a chart, an alpha.
Counterexample without_spare_formulas(const ClaimUnderTest& test, Counterexample counterexample);

}  // namespace pfaff
