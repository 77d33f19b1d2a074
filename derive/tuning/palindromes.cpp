#include <pfaff/derive/tuning/palindromes.hpp>

#include <algorithm>
#include <cmath>

namespace pfaff {

std::vector<PartialFlow> palindrome(const std::vector<Quad>& x, int stages) {
  const auto s = static_cast<std::size_t>(stages);
  std::vector<PartialFlow> flows;
  for (std::size_t k = 0; k <= s; ++k) {
    flows.push_back({0, x[std::min(k, s - k)]});
    if (k < s) flows.push_back({1, x[s / 2 + 1 + std::min(k, s - 1 - k)]});
  }
  return flows;
}

double length_of(const std::vector<PartialFlow>& flows) {
  double sum = 0;
  for (const PartialFlow& flow : flows) sum += std::abs(static_cast<double>(flow.length));
  return sum;
}

std::vector<Quad> in_quad(const std::vector<double>& x) { return {x.begin(), x.end()}; }

ConstrainedProblem numbers_of_palindromes(const TuningSettings& settings) {
  ConstrainedProblem problem;
  const int stages = settings.stages;
  problem.length = [stages](const std::vector<double>& x) {
    return length_of(palindrome(in_quad(x), stages));
  };
  problem.longest = settings.longest;
  // Lengths about those of equal steps, back and forth.
  problem.start = [stages](std::mt19937_64& random) {
    std::vector<double> x;
    for (int k = 0; k <= stages; ++k) x.push_back((3 * uniform(random) - 1) * 2 / stages);
    return x;
  };
  return problem;
}

ConstrainedProblem palindromes(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                               const TuningSettings& settings) {
  ConstrainedProblem problem = numbers_of_palindromes(settings);
  const int stages = settings.stages, order = settings.order;
  const Parts parts = settings.parts;
  problem.values = [&logarithm, &terms, stages](const std::vector<double>& x) {
    auto found = logarithm.of(palindrome(in_quad(x), stages));
    return ConstrainedProblem::Values{std::move(found.conditions), terms.weighted(found.brackets)};
  };
  problem.conditions = [stages, order, parts](const std::vector<Quad>& x) {
    std::vector<Quad> residuals;
    for (const OrderCondition& condition : splitting_conditions(palindrome(x, stages), order, parts))
      if (condition.order % 2 == 1) residuals.push_back(condition.residual);
    return residuals;
  };
  problem.holds = [stages, order, parts](const std::vector<Quad>& x) {
    return first_violated(splitting_conditions(palindrome(x, stages), order, parts), order,
                          precision_of_quad_coefficients / Quad(4)) == nullptr;
  };
  return problem;
}

}  // namespace pfaff
