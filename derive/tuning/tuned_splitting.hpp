// Splittings for one system and step: palindromes of a given order and number of forces whose shadow terms
// are small there, and processed methods P K P^-1 whose kernel K is such a palindrome.
//
// n steps of a processed method are P K^n P^-1, so that the processor P costs nothing in the long run. It is
// chosen in two parts (blanes-casas-ros1999). The kernel is of effective order p, fulfils fewer conditions
// than a method of order p does, and what no processor removes of its leading terms is small. The processor
// then makes the order of the whole p and removes the rest as far as its kicks and drifts allow.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/bench/studies/options.hpp>
#include <pfaff/derive/tuning/shadow_terms.hpp>
#include <pfaff/derive/tuning/splitting_logarithm.hpp>

namespace pfaff {

/// A splitting with lengths that fulfil the order conditions to round-off of quad.
struct TunedSplitting {
  std::vector<PartialFlow> flows;  // of the kernel, where there is a processor
  std::vector<PartialFlow> pre;    // the processor; a step is pre, flows and the inverse of pre
  double error = 0;                // ShadowTerms::of the whole step
  double error_of_kernel = 0;      // where there is a processor: what none removes
  Parts parts = Parts::general;    // for which it is of its order
};

/// How many numbers of a palindrome the conditions of order, or effective order where it is processed, leave
/// free; negative where there are too few.
int free_coefficients(const TuningSettings& settings);

/// InputError for an order that is odd or outside 2 ... 6, and where the order conditions leave nothing free
/// of the palindrome or of the processor.
void check(const TuningSettings& settings);

/// The best palindrome that the search finds, or the best kernel and a processor for it, for settings that
/// check() lets pass, a logarithm of that order, of all degrees where there is a processor, and the shadow
/// terms made with it. RunError where no start leads to a method of that order.
TunedSplitting tuned_splitting(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                               const TuningSettings& settings,
                               const std::function<void(double fraction)>& progress = {});

/// The states of a system along its motion from its initial state, `count` of them, as far apart as the
/// motion needs to go once as far as the state is long. InputError for systems without a separable autonomous
/// energy or with constraints; RunError where the motion cannot be followed.
std::vector<std::vector<double>> states_along_the_motion(const std::shared_ptr<const Model>& model,
                                                         int count);

/// The table of a splitting or of a processed method, which `--integrator FILE.toml` takes: its numbers with
/// 36 digits.
std::string splitting_table(const TunedSplitting& tuned, const std::string& name, int order,
                            const std::string& system);

}  // namespace pfaff
