// The logarithm of a splitting exp(a1 h A) exp(b1 h B) ... by its Lyndon words, fast enough for a search.
#pragma once

#include <vector>

#include <pfaff/integrators/order_conditions/word_conditions.hpp>

namespace pfaff {

/// Of palindromes of one even order; the logarithm of a palindrome has no words of even degree.
class SplittingLogarithm {
 public:
  explicit SplittingLogarithm(int order);

  struct Coordinates {
    /// The residuals of the order conditions of degrees 1, 3, ..., order - 1.
    std::vector<double> conditions;
    /// The coordinates of degrees order + 1 and order + 3 in the bracketings of their Lyndon words.
    std::vector<double> brackets;
  };
  [[nodiscard]] Coordinates of(const std::vector<PartialFlow>& flows) const;

  [[nodiscard]] const Words& words() const { return words_; }
  /// The Lyndon words of `brackets`, in their order.
  [[nodiscard]] const std::vector<std::size_t>& lyndon() const { return lyndon_; }

 private:
  int order_;
  Words words_;
  std::vector<std::size_t> lyndon_;
  std::vector<double> bracketings_;  // row i, column j: the coefficient of word i in the bracketing of word j
};

}  // namespace pfaff
