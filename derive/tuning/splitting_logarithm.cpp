#include <pfaff/derive/tuning/splitting_logarithm.hpp>

#include <numeric>

#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/integrators/order_conditions/lie_quotient.hpp>

namespace pfaff {

SplittingLogarithm::SplittingLogarithm(int order, Degrees degrees, Parts parts)
    : order_(order), stride_(degrees == Degrees::odd ? 2 : 1), words_({1, 1}, order + 3) {
  for (int degree = 1; degree <= order; degree += stride_) {
    auto& rows = condition_rows_.emplace_back();
    for (const std::vector<Quad>& row : condition_rows(degree, parts)) {
      auto& rounded = rows.emplace_back();
      for (const Quad& x : row) rounded.push_back(static_cast<double>(x));
    }
  }
  for (int degree = order + 1; degree <= order + 3; degree += stride_)
    for (const std::size_t word : words_.lyndon(degree)) lyndon_.push_back(word);
  const std::size_t n = lyndon_.size();
  bracketings_.resize(n * n);
  for (std::size_t j = 0; j < n; ++j) {
    const WordSeries<Quad> bracket = bracketing<Quad>(words_, lyndon_[j]);
    for (std::size_t i = 0; i < n; ++i) bracketings_[i * n + j] = static_cast<double>(bracket[lyndon_[i]]);
  }
}

std::vector<double> SplittingLogarithm::brackets(const WordSeries<double>& log) const {
  // A word has the coefficient 1 in its own bracketing, which holds no smaller Lyndon word.
  const std::size_t n = lyndon_.size();
  std::vector<double> result;
  for (std::size_t i = 0; i < n; ++i) {
    double c = log[lyndon_[i]];
    for (std::size_t j = 0; j < i; ++j) c -= bracketings_[i * n + j] * result[j];
    result.push_back(c);
  }
  return result;
}

SplittingLogarithm::Coordinates SplittingLogarithm::of(const std::vector<PartialFlow>& flows) const {
  const WordSeries<double> log = logarithm(series_of<double>(words_, flows));
  Coordinates result;
  int degree = 1;
  for (const auto& rows : condition_rows_) {
    std::vector<double> residual = coordinates(log, words_.lyndon(degree));
    if (degree == 1)
      for (double& x : residual) x -= 1;
    for (const std::vector<double>& row : rows)
      result.conditions.push_back(std::inner_product(row.begin(), row.end(), residual.begin(), 0.0));
    degree += stride_;
  }
  result.brackets = brackets(log);
  return result;
}

}  // namespace pfaff
