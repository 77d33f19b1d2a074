#include <pfaff/derive/tuning/effective_logarithm.hpp>

#include <cmath>

#include <pfaff/derive/tuning/constrained_search.hpp>

namespace pfaff {

namespace {

// Takes off what lies in the directions, which are orthonormal.
void take_off(std::vector<double>& vector, const std::vector<std::vector<double>>& directions) {
  for (const std::vector<double>& direction : directions) {
    double product = 0;
    for (std::size_t i = 0; i < vector.size(); ++i) product += direction[i] * vector[i];
    for (std::size_t i = 0; i < vector.size(); ++i) vector[i] -= product * direction[i];
  }
}

}  // namespace

Irremovable::Irremovable(const SplittingLogarithm& logarithm, const ShadowTerms& terms)
    : logarithm_(logarithm), terms_(terms) {
  const Words& words = logarithm.words();
  const auto whole = sum_of_letters<double>(words);
  const std::size_t n = logarithm.lyndon().size();
  std::vector<double> sizes(n);  // of each bracket on the system
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> unit(n, 0.0);
    unit[k] = 1;
    sizes[k] = norm_of(terms.weighted(unit));
  }
  for (int degree = logarithm.order(); degree < words.largest_degree(); ++degree)
    for (const std::size_t word : words.lyndon(degree)) {
      const std::vector<double> c = logarithm.brackets(commutator(bracketing<double>(words, word), whole));
      double summed = 0;
      for (std::size_t k = 0; k < n; ++k) summed += std::abs(c[k]) * sizes[k];
      std::vector<double> vector = terms.weighted(c);
      // Brackets may vanish or depend on each other on a system, and then what is left is rounding, of the
      // size of the root of round-off at most, since R is a root of sums of squares. What is kept is taken
      // off once more: the first time leaves rounding of the size of what was taken off.
      take_off(vector, removable_);
      if (!(norm_of(vector) > 1e-7 * summed)) continue;
      take_off(vector, removable_);
      const double size = norm_of(vector);
      for (double& x : vector) x /= size;
      removable_.push_back(std::move(vector));
    }
}

std::vector<double> Irremovable::of(const WordSeries<double>& log) const {
  std::vector<double> vector = all(log);
  take_off(vector, removable_);
  return vector;
}

std::vector<double> Irremovable::all(const WordSeries<double>& log) const {
  return terms_.weighted(logarithm_.brackets(log));
}

}  // namespace pfaff
