#include <pfaff/derive/tuning/tuned_splitting.hpp>

#include <pfaff/derive/tuning/palindromes.hpp>
#include <pfaff/derive/tuning/processor.hpp>

namespace pfaff {

namespace {

// The number of conditions that are left when those of the odd degrees below `order` + 1 are: in general, by
// Witt's formula, 2, 2, 6, 18 of degree 1, 3, 5, 7. A processor takes on as many of a degree d > 1 as there
// are Lyndon words of degree d - 1.
int conditions_of(const TuningSettings& settings) {
  const Words words({1, 1}, settings.order);
  int sum = 0;
  for (int degree = 1; degree < settings.order; degree += 2) {
    sum += static_cast<int>(condition_rows(degree, settings.parts).size());
    if (settings.processor > 0 && degree > 1) sum -= static_cast<int>(words.lyndon(degree - 1).size());
  }
  return sum;
}

}  // namespace

int free_coefficients(const TuningSettings& settings) {
  return settings.stages + 1 - conditions_of(settings);
}

void check(const TuningSettings& settings) {
  constexpr int largest_order = 6;
  if (settings.order < 2 || settings.order > largest_order || settings.order % 2 != 0)
    throw InputError("order " + std::to_string(settings.order) + ": expected 2, 4 or 6");
  if (settings.processor < 0)
    throw InputError("a processor of " + std::to_string(settings.processor) +
                     " kicks: expected a number above 0, or 0 for none");
  const bool processed = settings.processor > 0;
  if (const int number = free_coefficients(settings); number < 1)
    throw InputError("a palindrome of " + std::string(processed ? "effective " : "") + "order " +
                     std::to_string(settings.order) + " with " + std::to_string(settings.stages) +
                     " forces a step has no free coefficient; expected at least " +
                     std::to_string(settings.stages + 1 - number) + " forces");
  if (const int kicks = fewest_kicks_of_a_processor(settings.order); processed && settings.processor < kicks)
    throw InputError("a processor of " + std::to_string(settings.processor) +
                     (settings.processor == 1 ? " kick" : " kicks") + " for order " +
                     std::to_string(settings.order) + " has no free coefficient; expected at least " +
                     std::to_string(kicks) + " kicks");
}

namespace {

RunError none_of(const TuningSettings& settings, const std::string& what, const char* more) {
  return RunError("none of " + std::to_string(settings.starts) + " starts leads to a " + what + "; more " +
                  more + " may");
}

TunedSplitting tuned_processed(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                               const TuningSettings& settings,
                               const std::function<void(double fraction)>& progress) {
  const Irremovable irremovable(logarithm, terms);
  const KernelSeries<double> series(logarithm.words(), settings.order);
  std::mt19937_64 random(settings.seed);
  // Four searches, each of which is a quarter of the work.
  int searches = 0;
  const auto quarter = [&](double fraction) {
    if (progress) progress((searches + fraction) / 4);
  };
  TunedSplitting best;
  bool kernel_found = false;
  // How much a processor leaves is known only once it is there. With the smaller weight a kernel has less
  // that none removes, with the larger one it is removed better.
  for (const double removable : {0.01, 0.1}) {
    const auto x =
        least_squares(kernels(logarithm, irremovable, removable, settings), random, settings.starts, quarter);
    ++searches;
    if (x) {
      kernel_found = true;
      TunedSplitting found{palindrome(*x, settings.stages), {}, 0, 0};
      if (const auto pre = least_squares(processors(logarithm, terms, found.flows, settings), random,
                                         settings.starts, quarter)) {
        found.pre = alternating(*pre);
        found.error = terms.of(logarithm.of(processed_step(found.pre, found.flows)).brackets);
        found.error_of_kernel = norm_of(irremovable.of(series.of(found.flows).logarithm));
        if (best.pre.empty() || found.error < best.error) best = std::move(found);
      }
    }
    ++searches;
  }
  const std::string order = std::to_string(settings.order);
  if (!kernel_found)
    throw none_of(
        settings,
        "kernel of effective order " + order + " with " + std::to_string(settings.stages) + " forces",
        "starts or forces");
  if (best.pre.empty())
    throw none_of(settings,
                  "processor with " + std::to_string(settings.processor) + " kicks for order " + order,
                  "starts or kicks of the processor");
  return best;
}

}  // namespace

TunedSplitting tuned_splitting(const SplittingLogarithm& logarithm, const ShadowTerms& terms,
                               const TuningSettings& settings,
                               const std::function<void(double fraction)>& progress) {
  if (settings.processor > 0) return tuned_processed(logarithm, terms, settings, progress);
  std::mt19937_64 random(settings.seed);
  const auto x = least_squares(palindromes(logarithm, terms, settings), random, settings.starts, progress);
  if (!x)
    throw none_of(settings,
                  "splitting of order " + std::to_string(settings.order) + " with " +
                      std::to_string(settings.stages) + " forces",
                  "starts or forces");
  TunedSplitting best;
  best.flows = palindrome(*x, settings.stages);
  best.parts = settings.parts;
  best.error = terms.of(logarithm.of(best.flows).brackets);
  return best;
}

}  // namespace pfaff
