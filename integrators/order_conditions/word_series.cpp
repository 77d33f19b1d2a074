#include <pfaff/integrators/order_conditions/word_series.hpp>

#include <algorithm>

#include <pfaff/core/numbers/quad.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace pfaff {

namespace {
using Letters = std::vector<std::size_t>;

bool is_lyndon(const Letters& word) {
  for (auto ending = word.begin() + 1; ending != word.end(); ++ending)
    if (!std::lexicographical_compare(word.begin(), word.end(), ending, word.end())) return false;
  return true;
}
}  // namespace

Words::Words(std::vector<int> degrees, int degree)
    : degrees_(std::move(degrees)), degree_(degree), entries_(1) {
  for (int sum = 1; sum <= degree; ++sum)
    for (std::size_t w = 0, known = entries_.size(); w < known; ++w)
      for (std::size_t letter = 0; letter < letters(); ++letter)
        if (entries_[w].degree + degrees_[letter] == sum) entries_.push_back({w, letter, sum});
  extended_.assign(size() * letters(), none);
  for (std::size_t w = 1; w < size(); ++w)
    extended_[entries_[w].beginning * letters() + entries_[w].last] = w;
}

std::vector<std::size_t> Words::spelt(std::size_t word) const {
  Letters letters;
  for (; word != 0; word = beginning(word)) letters.push_back(last(word));
  std::reverse(letters.begin(), letters.end());
  return letters;
}

std::size_t Words::find(const std::vector<std::size_t>& letters) const {
  std::size_t word = 0;
  for (const std::size_t letter : letters) {
    word = extended(word, letter);
    if (word == none) break;
  }
  return word;
}

std::vector<std::size_t> Words::lyndon(int degree) const {
  std::vector<std::size_t> list;
  for (std::size_t w = 1; w < size(); ++w)
    if (entries_[w].degree == degree && is_lyndon(spelt(w))) list.push_back(w);
  return list;
}

std::pair<std::size_t, std::size_t> Words::factors(std::size_t lyndon_word) const {
  const Letters letters = spelt(lyndon_word);
  auto middle = letters.begin() + 1;
  while (!is_lyndon(Letters(middle, letters.end()))) ++middle;
  return {find(Letters(letters.begin(), middle)), find(Letters(middle, letters.end()))};
}

template <class T>
WordSeries<T> bracketing(const Words& words, std::size_t lyndon_word) {
  if (words.beginning(lyndon_word) == 0) {
    WordSeries<T> letter(words);
    letter[lyndon_word] = T(1);
    return letter;
  }
  const auto [beginning, ending] = words.factors(lyndon_word);
  return commutator(bracketing<T>(words, beginning), bracketing<T>(words, ending));
}

template WordSeries<double> bracketing(const Words& words, std::size_t lyndon_word);
template WordSeries<Quad> bracketing(const Words& words, std::size_t lyndon_word);
template WordSeries<Rational> bracketing(const Words& words, std::size_t lyndon_word);

}  // namespace pfaff
