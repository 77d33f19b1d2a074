// Splittings for one system and step: palindromes of a given order and number of forces whose shadow terms
// are small there.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <pfaff/bench/tuning/shadow_terms.hpp>
#include <pfaff/bench/tuning/splitting_logarithm.hpp>

namespace pfaff {

struct TuningSettings {
  int order = 4;   // even
  int stages = 6;  // forces a step; drifts come first and last
  std::uint64_t seed = 1;
  int starts = 60;  // of the search, drawn by `seed`
  /// The sum of the lengths of all flows, taken positive, may be so large at most: long steps back and forth
  /// make terms of higher order large.
  double longest = 5;
};

/// A splitting with lengths that fulfil the order conditions to round-off of quad.
struct TunedSplitting {
  std::vector<PartialFlow> flows;
  double error = 0;  // ShadowTerms::of
};

/// How many numbers of a palindrome the order conditions leave free; negative where there are too few.
int free_coefficients(int order, int stages);

/// InputError for an order that is odd or outside 2 ... 6, and where the order conditions leave nothing free.
void check(const TuningSettings& settings);

/// The best palindrome that the search finds, for settings that check() lets pass, a logarithm of that order
/// and the shadow terms made with it. RunError where no start leads to a method of that order.
TunedSplitting tuned_splitting(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                               const TuningSettings& settings,
                               const std::function<void(double fraction)>& progress = {});

/// The states of a system along its motion from its initial state, `count` of them, as far apart as the
/// motion needs to go once as far as the state is long. InputError for systems without a separable autonomous
/// energy or with constraints; RunError where the motion cannot be followed.
std::vector<std::vector<double>> states_along_the_motion(const std::shared_ptr<const Model>& model,
                                                         int count);

/// The table of a splitting, which `--integrator FILE.toml` takes: its numbers with 36 digits.
std::string splitting_table(const TunedSplitting& tuned, const std::string& name, int order,
                            const std::string& system);

}  // namespace pfaff
