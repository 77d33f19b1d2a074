// The least squares of some functions of a few numbers under equations between them, from many starts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

/// What is sought: numbers x for which the conditions g(x) are 0 and the residuals r(x) are small.
struct ConstrainedProblem {
  struct Values {
    std::vector<double> conditions, residuals;
  };
  std::function<Values(const std::vector<double>& x)> values;
  /// The same conditions in quad, and whether they hold to round-off of quad.
  std::function<std::vector<Quad>(const std::vector<Quad>& x)> conditions;
  std::function<bool(const std::vector<Quad>& x)> holds;
  /// The sum of |x| counted as often as each number is used, which may be `longest` at most.
  std::function<double(const std::vector<double>& x)> length;
  double longest = 0;
  /// A random start of the search.
  std::function<std::vector<double>(std::mt19937_64& random)> start;
};

/// The numbers of the smallest |r| that searches from so many random starts lead to, with conditions that
/// hold to round-off of quad. Nothing where none leads to such numbers, or only to too long ones.
std::optional<std::vector<Quad>> least_squares(const ConstrainedProblem& problem, std::mt19937_64& random,
                                               int starts,
                                               const std::function<void(double fraction)>& progress = {});

/// A random number between 0 and 1, the same on every machine.
double uniform(std::mt19937_64& random);

/// |v|
double norm_of(const std::vector<double>& v);

}  // namespace pfaff
