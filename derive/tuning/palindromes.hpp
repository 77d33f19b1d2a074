// Splittings that read the same from both ends, as numbers for a search.
#pragma once

#include <vector>

#include <pfaff/derive/tuning/constrained_search.hpp>
#include <pfaff/derive/tuning/tuned_splitting.hpp>

namespace pfaff {

/// The palindrome with so many kicks, `stages`, between drifts. x are its lengths, stages + 1 of them: first
/// those of its first drifts, then those of its first kicks.
std::vector<PartialFlow> palindrome(const std::vector<Quad>& x, int stages);

/// The search for the palindrome of order p with small shadow terms, for settings without a processor. What
/// is given must outlive it.
ConstrainedProblem palindromes(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                               const TuningSettings& settings);

/// A problem whose numbers are those of the palindrome of these settings: all but values, conditions and
/// holds.
ConstrainedProblem numbers_of_palindromes(const TuningSettings& settings);

/// |x1| + |x2| + ... over all flows.
double length_of(const std::vector<PartialFlow>& flows);

/// Numbers in quad.
std::vector<Quad> in_quad(const std::vector<double>& x);

}  // namespace pfaff
