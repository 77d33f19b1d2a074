#include <pfaff/derive/tuning/processor.hpp>

#include <pfaff/derive/tuning/palindromes.hpp>

namespace pfaff {

namespace {

// The Lyndon words of the degrees 1, 2, ..., order - 1, which a processor's logarithm is given for.
std::vector<std::size_t> given_words(const Words& words, int order) {
  std::vector<std::size_t> given;
  for (int degree = 1; degree < order; ++degree)
    for (const std::size_t word : words.lyndon(degree)) given.push_back(word);
  return given;
}

// The coefficients of the words of a processor's logarithm.
template <class T>
std::vector<T> of_processor(const Words& words, const std::vector<std::size_t>& given,
                            const std::vector<PartialFlow>& pre) {
  return coordinates(logarithm(series_of<T>(words, pre)), given);
}

template <class T>
std::vector<T> difference(std::vector<T> a, const std::vector<T>& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = a[k] - b[k];
  return a;
}

}  // namespace

std::vector<PartialFlow> alternating(const std::vector<Quad>& x) {
  std::vector<PartialFlow> flows;
  for (std::size_t k = 0; k < x.size(); ++k) flows.push_back({k % 2, x[k]});
  return flows;
}

int fewest_kicks_of_a_processor(int order) {
  const Words words({1, 1}, order);
  return static_cast<int>(given_words(words, order).size()) / 2 + 1;
}

ConstrainedProblem kernels(const SplittingLogarithm& logarithm, const Irremovable& terms, double removable,
                           const TuningSettings& settings) {
  ConstrainedProblem problem = numbers_of_palindromes(settings);
  const int stages = settings.stages, order = settings.order;
  problem.values = [series = KernelSeries<double>(logarithm.words(), order), &terms, removable,
                    stages](const std::vector<double>& x) {
    auto lifted = series.of(palindrome(in_quad(x), stages));
    std::vector<double> residuals = terms.of(lifted.logarithm);
    for (const double term : terms.all(lifted.logarithm)) residuals.push_back(removable * term);
    return ConstrainedProblem::Values{std::move(lifted.conditions), std::move(residuals)};
  };
  const auto words = std::make_shared<const Words>(std::vector<int>{1, 1}, order);
  problem.conditions = [words, series = KernelSeries<Quad>(*words, order),
                        stages](const std::vector<Quad>& x) {
    return series.of(palindrome(x, stages)).conditions;
  };
  problem.holds = [stages, order](const std::vector<Quad>& x) {
    return first_violated(effective_conditions(palindrome(x, stages), order), order,
                          precision_of_quad_coefficients / Quad(4)) == nullptr;
  };
  return problem;
}

ConstrainedProblem processors(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                              const std::vector<PartialFlow>& kernel, const TuningSettings& settings) {
  const int order = settings.order;
  ConstrainedProblem problem;
  problem.length = [](const std::vector<double>& x) { return length_of(alternating(in_quad(x))); };
  problem.longest = settings.longest;
  // Searches that begin with long flows, or with some that do not add up to 0, end with longer ones.
  problem.start = [kicks = settings.processor](std::mt19937_64& random) {
    constexpr double longest = 0.2;
    std::vector<double> x;
    for (int k = 0; k < 2 * kicks; ++k) x.push_back((2 * uniform(random) - 1) * longest);
    for (std::size_t part : {0U, 1U}) {
      double sum = 0;
      for (std::size_t k = part; k < x.size(); k += 2) sum += x[k];
      for (std::size_t k = part; k < x.size(); k += 2) x[k] -= sum / kicks;
    }
    return x;
  };
  // Words of lower degrees are enough for the conditions, and are faster.
  const auto low = std::make_shared<const Words>(std::vector<int>{1, 1}, order - 1);
  const auto given = std::make_shared<const std::vector<std::size_t>>(given_words(*low, order));
  const Words with_order({1, 1}, order);
  // The numbers of words do not depend on the largest degree.
  const std::vector<Quad> wanted =
      coordinates(pfaff::logarithm(KernelSeries<Quad>(with_order, order).of(kernel).processor), *given);
  std::vector<double> rounded;
  for (const Quad& number : wanted) rounded.push_back(static_cast<double>(number));
  problem.values = [&logarithm, &terms, low, given, rounded,
                    step = series_of<double>(logarithm.words(), kernel)](const std::vector<double>& x) {
    const std::vector<PartialFlow> pre = alternating(in_quad(x));
    const Words& words = logarithm.words();
    const auto log =
        pfaff::logarithm(series_of<double>(words, pre) * step * series_of<double>(words, inverse(pre)));
    return ConstrainedProblem::Values{difference(of_processor<double>(*low, *given, pre), rounded),
                                      terms.weighted(logarithm.brackets(log))};
  };
  problem.conditions = [low, given, wanted](const std::vector<Quad>& x) {
    return difference(of_processor<Quad>(*low, *given, alternating(x)), wanted);
  };
  problem.holds = [kernel, order](const std::vector<Quad>& x) {
    return first_violated(splitting_conditions(processed_step(alternating(x), kernel), order), order,
                          precision_of_quad_coefficients / Quad(4)) == nullptr;
  };
  return problem;
}

}  // namespace pfaff
