// The logarithm of a splitting exp(a1 h A) exp(b1 h B) ... by its Lyndon words, fast enough for a search.
#pragma once

#include <vector>

#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace pfaff {

/// A composition of flows as a series of words, the flow that acts first on the left.
template <class T>
WordSeries<T> series_of(const Words& words, const std::vector<PartialFlow>& flows) {
  WordSeries<T> product = WordSeries<T>::one(words);
  for (const PartialFlow& flow : flows) product.times_exponential(flow.part, static_cast<T>(flow.length));
  return product;
}

/// The degrees that a logarithm is looked at in.
enum class Degrees {
  odd,  // of palindromes, whose logarithms have no words of even degree
  all,
};

/// Of splittings of one even order.
class SplittingLogarithm {
 public:
  /// The conditions are those for such parts; the brackets are all.
  explicit SplittingLogarithm(int order, Degrees degrees = Degrees::odd, Parts parts = Parts::general);

  struct Coordinates {
    /// The residuals of the order conditions of degrees 1, 3, ..., order - 1, or 1, 2, ..., order.
    std::vector<double> conditions;
    /// The coordinates of degrees order + 1 and order + 3, or of all from the one to the other, in the
    /// bracketings of their Lyndon words.
    std::vector<double> brackets;
  };
  [[nodiscard]] Coordinates of(const std::vector<PartialFlow>& flows) const;
  /// `brackets` of a logarithm, a series of words().
  [[nodiscard]] std::vector<double> brackets(const WordSeries<double>& log) const;

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] const Words& words() const { return words_; }
  /// The Lyndon words of `brackets`, in their order.
  [[nodiscard]] const std::vector<std::size_t>& lyndon() const { return lyndon_; }

 private:
  int order_, stride_;
  Words words_;
  std::vector<std::vector<std::vector<double>>> condition_rows_;  // by degree: 1, 1 + stride, ...
  std::vector<std::size_t> lyndon_;
  std::vector<double> bracketings_;  // row i, column j: the coefficient of word i in the bracketing of word j
};

}  // namespace pfaff
