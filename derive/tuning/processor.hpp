// The two searches behind a processed splitting: for the kernel and, once it is there, for the processor.
#pragma once

#include <vector>

#include <pfaff/derive/tuning/constrained_search.hpp>
#include <pfaff/derive/tuning/effective_logarithm.hpp>
#include <pfaff/derive/tuning/tuned_splitting.hpp>

namespace pfaff {

/// The flows of these lengths in turn, a drift first.
std::vector<PartialFlow> alternating(const std::vector<Quad>& x);

/// The fewest kicks, with as many drifts, of which the conditions on a processor for this order leave
/// something free: its logarithm is given up to degree order - 1.
int fewest_kicks_of_a_processor(int order);

/// The search for the palindrome of effective order p whose irremovable terms are small. All its terms are
/// counted beside them with the weight `removable`, since the processor has a few flows only and what it
/// removes leaves terms of higher orders. What is given must outlive it.
ConstrainedProblem kernels(const SplittingLogarithm& logarithm, const Irremovable& terms, double removable,
                           const TuningSettings& settings);

/// The search for the processor of a kernel: its logarithm up to degree p - 1 is the one that makes the step
/// of order p, and the shadow terms of the step are small.
ConstrainedProblem processors(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                              const std::vector<PartialFlow>& kernel, const TuningSettings& settings);

}  // namespace pfaff
