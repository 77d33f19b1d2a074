#include <pfaff/integrators/composition/composition_weights.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>

#include <pfaff/core/linear/lu.hpp>
#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

namespace {

// All words of odd letters with the sum `weight`.
void append_words(int weight, Word& start, std::vector<Word>& words) {
  if (weight == 0) words.push_back(start);
  for (int letter = 1; letter <= weight; letter += 2) {
    start.push_back(letter);
    append_words(weight - letter, start, words);
    start.pop_back();
  }
}

// True for Lyndon words: those that are smaller than each of their proper endings.
bool lyndon(const Word& word) {
  for (auto ending = word.begin() + 1; ending != word.end(); ++ending)
    if (!std::lexicographical_compare(word.begin(), word.end(), ending, word.end())) return false;
  return true;
}

// Keeps, stage by stage, the coefficient of every beginning of the word in the product of the stages so far.
// The next stage appends some letters: those from l to m - 1, which stand in its exponential with the
// coefficient gamma^(their sum) / (m - l)!.
template <class T>
T coefficient(std::span<const T> weights, const Word& word) {
  std::vector<T> begun(word.size() + 1, T(0));
  begun[0] = T(1);
  for (const T& gamma : weights)
    for (std::size_t m = word.size(); m > 0; --m) {
      T term(1);
      for (std::size_t l = m; l-- > 0;) {
        for (int power = 0; power < word[l]; ++power) term = term * gamma;
        term = term / T(static_cast<int>(m - l));
        begun[m] = begun[m] + term * begun[l];
      }
    }
  return begun.back();
}

// The recursion of both jumps: a method of order p - 2 in `outer` equal parts on either side of a negative
// one in the middle.
std::vector<Quad> jumped(int order, int outer) {
  if (order == 2) return {Quad(1)};
  const std::vector<Quad> inner = jumped(order - 2, outer);
  const Quad root = pow(Quad(2 * outer), Quad(1) / Quad(order - 1));
  const Quad side = Quad(1) / (Quad(2 * outer) - root), middle = Quad(1) - Quad(2 * outer) * side;
  std::vector<Quad> weights;
  for (int k = 0; k <= 2 * outer; ++k)
    for (const Quad& gamma : inner) weights.push_back((k == outer ? middle : side) * gamma);
  return weights;
}

// gamma_1, gamma_2, ... up to the one in the middle, from kahan-li1997 (hairer-lubich-wanner2006 (V.3.11),
// (V.3.13)).
constexpr std::array<const char*, 5> published_order_6{
    "0.39216144400731413927925056", "0.33259913678935943859974864", "-0.70624617255763935980996482",
    "0.08221359629355080023149045", "0.79854399093482996339895035"};
constexpr std::array<const char*, 9> published_order_8{
    "0.13020248308889008087881763", "0.56116298177510838456196441",  "-0.38947496264484728640807860",
    "0.15884190655515560089621075", "-0.39590389413323757733623154", "0.18453964097831570709183254",
    "0.25837438768632204729397911", "0.29501172360931029887096624",  "-0.60550853383003451169892108"};

template <class T>
std::vector<T> mirrored(const std::vector<T>& half) {
  std::vector<T> weights = half;
  weights.insert(weights.end(), half.rbegin() + 1, half.rend());
  return weights;
}

// Newton's method for the order conditions. There is one more weight than there are conditions, so that of
// all corrections that fulfil the linearised conditions the smallest is taken.
template <std::size_t N>
std::vector<Quad> polished(const std::array<const char*, N>& published, int order) {
  using D = Dual<Quad, static_cast<int>(N)>;
  std::vector<Quad> half(N);
  for (std::size_t i = 0; i < N; ++i) parse(published[i], half[i]);
  const std::vector<Word> words = order_condition_words(order);
  const std::size_t conditions = words.size();
  for (int iteration = 0; iteration < 4; ++iteration) {  // from 26 digits, quadratically: two would do
    std::vector<D> variables;
    for (std::size_t i = 0; i < N; ++i) variables.push_back(D::variable(half[i], static_cast<int>(i)));
    const std::vector<D> weights = mirrored(variables);
    std::vector<D> defect;
    for (const Word& word : words) {
      defect.push_back(coefficient<D>(weights, word));
      if (word == Word{1}) defect.back() = defect.back() - D(1);
    }
    LU<Quad> normal(conditions);
    std::vector<Quad> right(conditions), multiplier(conditions);
    for (std::size_t a = 0; a < conditions; ++a) {
      right[a] = defect[a].value;
      for (std::size_t b = 0; b < conditions; ++b) {
        normal(a, b) = Quad(0);
        for (std::size_t i = 0; i < N; ++i) normal(a, b) += defect[a].derivative[i] * defect[b].derivative[i];
      }
    }
    normal.factor();
    normal.solve(right.data(), multiplier.data());
    for (std::size_t a = 0; a < conditions; ++a)
      for (std::size_t i = 0; i < N; ++i) half[i] -= defect[a].derivative[i] * multiplier[a];
  }
  return mirrored(half);
}

}  // namespace

std::vector<Word> order_condition_words(int order) {
  std::vector<Word> words, independent;
  Word start;
  for (int weight = 1; weight < order; weight += 2) append_words(weight, start, words);
  std::copy_if(words.begin(), words.end(), std::back_inserter(independent), lyndon);
  return independent;
}

Quad word_coefficient(const std::vector<Quad>& weights, const Word& word) {
  return coefficient<Quad>(weights, word);
}

std::vector<Quad> yoshida_weights(int order) { return jumped(order, 1); }
std::vector<Quad> suzuki_weights(int order) { return jumped(order, 2); }

// Found once: that takes as long as hundreds of steps.
std::vector<Quad> kahan_li_weights(int order) {
  if (order == 6) {
    static const std::vector<Quad> of_order_6 = polished(published_order_6, 6);
    return of_order_6;
  }
  if (order == 8) {
    static const std::vector<Quad> of_order_8 = polished(published_order_8, 8);
    return of_order_8;
  }
  throw std::invalid_argument("kahan_li_weights: order " + std::to_string(order) + ", expected 6 or 8");
}

}  // namespace pfaff
