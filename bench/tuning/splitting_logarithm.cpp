#include <pfaff/bench/tuning/splitting_logarithm.hpp>

#include <pfaff/core/numbers/quad.hpp>

namespace pfaff {

SplittingLogarithm::SplittingLogarithm(int order) : order_(order), words_({1, 1}, order + 3) {
  for (const int degree : {order + 1, order + 3})
    for (const std::size_t word : words_.lyndon(degree)) lyndon_.push_back(word);
  const std::size_t n = lyndon_.size();
  bracketings_.resize(n * n);
  for (std::size_t j = 0; j < n; ++j) {
    const WordSeries<Quad> bracket = bracketing<Quad>(words_, lyndon_[j]);
    for (std::size_t i = 0; i < n; ++i) bracketings_[i * n + j] = static_cast<double>(bracket[lyndon_[i]]);
  }
}

SplittingLogarithm::Coordinates SplittingLogarithm::of(const std::vector<PartialFlow>& flows) const {
  WordSeries<double> product = WordSeries<double>::one(words_);
  for (const PartialFlow& flow : flows)
    product.times_exponential(flow.part, static_cast<double>(flow.length));
  const WordSeries<double> log = logarithm(std::move(product));
  Coordinates result;
  for (int degree = 1; degree < order_; degree += 2)
    for (const std::size_t word : words_.lyndon(degree))
      result.conditions.push_back(log[word] - (degree == 1 ? 1 : 0));
  // A word has the coefficient 1 in its own bracketing, which holds no smaller Lyndon word.
  const std::size_t n = lyndon_.size();
  for (std::size_t i = 0; i < n; ++i) {
    double c = log[lyndon_[i]];
    for (std::size_t j = 0; j < i; ++j) c -= bracketings_[i * n + j] * result.brackets[j];
    result.brackets.push_back(c);
  }
  return result;
}

}  // namespace pfaff
