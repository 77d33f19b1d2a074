#include <pfaff/integrators/order_conditions/word_conditions.hpp>

#include <algorithm>

#include <pfaff/integrators/order_conditions/lie_quotient.hpp>

namespace pfaff {

namespace {

using Series = WordSeries<Quad>;
constexpr std::size_t drift = 0, kick = 1;

// What is divided out consists of vectors of small integers, so that anything below this is rounding.
const Quad rounding_of_integers = Quad(1e-20);

// The name of a word, with runs of a letter as powers.
std::string name_of(const Words& words, std::size_t word, const std::vector<std::string>& letters) {
  std::string text;
  const std::vector<std::size_t> spelt = words.spelt(word);
  for (std::size_t k = 0; k < spelt.size();) {
    std::size_t end = k;
    while (end < spelt.size() && spelt[end] == spelt[k]) ++end;
    text += (text.empty() ? "" : " ") + letters[spelt[k]];
    if (end - k > 1) text += "^" + std::to_string(end - k);
    k = end;
  }
  return text;
}

// Degree by degree a basis of the ideal of all brackets with two kicks or more beyond the drifts, or nothing.
class Ideal {
 public:
  Ideal(const Words& words, Parts parts)
      : words_(words), basis_(static_cast<std::size_t>(words.largest_degree()) + 1) {
    if (parts == Parts::general) return;
    for (int degree = 4; degree <= words.largest_degree(); ++degree) {
      const std::vector<std::size_t> lyndon = words.lyndon(degree);
      ReducedSpan<Quad> span(lyndon.size());
      const auto add = [&](Series element) {
        if (span.add(coordinates(element, lyndon), rounding_of_integers))
          basis_[static_cast<std::size_t>(degree)].push_back(std::move(element));
      };
      for (const std::size_t word : lyndon)
        if (2 * kicks(word) >= degree + 2) add(bracketing<Quad>(words, word));
      for (const Series& element : basis_[static_cast<std::size_t>(degree) - 1])
        for (const std::size_t x : {drift, kick}) add(commutator(letter(x), element));
    }
  }
  [[nodiscard]] Series letter(std::size_t which) const {
    Series series(words_);
    series[words_.extended(0, which)] = Quad(1);
    return series;
  }
  // The span of its elements of a degree in the coordinates of the Lyndon words, each with `beyond` zeros
  // after them.
  [[nodiscard]] ReducedSpan<Quad> span(int degree, std::size_t beyond = 0) const {
    const std::vector<std::size_t> lyndon = words_.lyndon(degree);
    ReducedSpan<Quad> result(lyndon.size());
    for (const Series& element : basis_[static_cast<std::size_t>(degree)]) {
      std::vector<Quad> vector = coordinates(element, lyndon);
      vector.resize(lyndon.size() + beyond);
      result.add(std::move(vector), rounding_of_integers);
    }
    return result;
  }

 private:
  [[nodiscard]] int kicks(std::size_t word) const {
    const std::vector<std::size_t> letters = words_.spelt(word);
    return static_cast<int>(std::count(letters.begin(), letters.end(), kick));
  }

  const Words& words_;
  std::vector<std::vector<Series>> basis_;
};

Series product_of(const Words& words, const std::vector<PartialFlow>& flows, bool magnitudes = false) {
  Series product = Series::one(words);
  for (const PartialFlow& flow : flows)
    product.times_exponential(flow.part, magnitudes ? abs(flow.length) : flow.length);
  return product;
}

const std::vector<std::string>& parts_named() {
  static const std::vector<std::string> names{"drift", "kick"};
  return names;
}

// Appends the conditions of one degree: what is left of the logarithm's part of that degree, less the letters
// that it has to be, in the span. `sizes` are the words of the product of magnitudes.
void append_conditions(std::vector<OrderCondition>& conditions, const Series& logarithm, const Series& sizes,
                       const ReducedSpan<Quad>& span, std::size_t beyond, int degree,
                       const std::vector<std::string>& letters, const std::string& kind,
                       std::vector<Quad>* left_beyond = nullptr) {
  const Words& words = logarithm.words();
  const std::vector<std::size_t> lyndon = words.lyndon(degree);
  std::vector<Quad> vector = coordinates(logarithm, lyndon);
  Quad scale(1);
  for (std::size_t k = 0; k < lyndon.size(); ++k) {
    if (degree == 1 && words.degree(lyndon[k]) == 1) vector[k] -= Quad(1);
    scale = std::max(scale, sizes[lyndon[k]]);
  }
  vector.resize(lyndon.size() + beyond);
  span.reduce(vector);
  for (std::size_t k = 0; k < lyndon.size(); ++k)
    if (!span.is_pivot(k))
      conditions.push_back({kind + name_of(words, lyndon[k], letters) + (degree == 1 ? " = 1" : " = 0"),
                            degree, vector[k], scale});
  if (left_beyond != nullptr)
    left_beyond->assign(vector.begin() + static_cast<std::ptrdiff_t>(lyndon.size()), vector.end());
}

}  // namespace

std::vector<OrderCondition> splitting_conditions(const std::vector<PartialFlow>& flows, int order,
                                                 Parts parts) {
  const Words words({1, 1}, order);
  const Ideal ideal(words, parts);
  const Series sizes = product_of(words, flows, true), log = logarithm(product_of(words, flows));
  std::vector<OrderCondition> conditions;
  for (int degree = 1; degree <= order; ++degree)
    append_conditions(conditions, log, sizes, ideal.span(degree), 0, degree, parts_named(), "the Lie word ");
  return conditions;
}

std::vector<std::vector<Quad>> condition_rows(int degree, Parts parts) {
  const Words words({1, 1}, degree);
  const ReducedSpan<Quad> span = Ideal(words, parts).span(degree);
  const std::size_t count = words.lyndon(degree).size();
  std::vector<std::vector<Quad>> rows;
  for (std::size_t k = 0; k < count; ++k)
    if (!span.is_pivot(k)) rows.emplace_back(count);
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<Quad> column(count);
    column[j] = Quad(1);
    span.reduce(column);
    for (std::size_t k = 0, row = 0; k < count; ++k)
      if (!span.is_pivot(k)) rows[row++][j] = column[k];
  }
  return rows;
}

std::vector<OrderCondition> near_integrable_conditions(const std::vector<PartialFlow>& flows,
                                                       const std::vector<int>& orders) {
  const int largest = orders.front();
  const Words words({1, 1}, largest);
  const Series sizes = product_of(words, flows, true), log = logarithm(product_of(words, flows));
  std::vector<OrderCondition> conditions;
  for (int degree = 1; degree <= largest; ++degree)
    for (const std::size_t word : words.lyndon(degree)) {
      const std::vector<std::size_t> letters = words.spelt(word);
      const auto perturbed = static_cast<std::size_t>(std::count(letters.begin(), letters.end(), kick));
      if (degree > orders[std::min(std::max<std::size_t>(perturbed, 1), orders.size()) - 1]) continue;
      Quad residual = log[word];
      if (degree == 1) residual -= Quad(1);
      conditions.push_back(
          {"the Lie word " + name_of(words, word, {"A", "B"}) + (degree == 1 ? " = 1" : " = 0"), degree,
           residual, std::max(Quad(1), sizes[word])});
    }
  return conditions;
}

namespace {

// Words in the letters Y1, Y3, ... of a symmetric base, and the compositions of its steps as series of them.
class Compositions {
 public:
  explicit Compositions(int order) : words_(degrees_up_to(order), order) {
    for (std::size_t letter = 0; letter < words_.letters(); ++letter)
      letters_.push_back("Y" + std::to_string(words_.degree_of_letter(letter)));
  }
  [[nodiscard]] const Words& words() const { return words_; }
  [[nodiscard]] const std::vector<std::string>& letters() const { return letters_; }
  [[nodiscard]] Series of(const std::vector<Quad>& weights, bool magnitudes = false) const {
    Series product = Series::one(words_);
    for (const Quad& weight : weights) {
      std::vector<Quad> powers;
      for (std::size_t letter = 0; letter < words_.letters(); ++letter) {
        Quad power(1);
        for (int k = 0; k < words_.degree_of_letter(letter); ++k) power *= weight;
        powers.push_back(magnitudes ? abs(power) : power);
      }
      product.times_exponential_of_sum(powers);
    }
    return product;
  }

 private:
  static std::vector<int> degrees_up_to(int order) {
    std::vector<int> degrees;
    for (int degree = 1; degree <= order; degree += 2) degrees.push_back(degree);
    return degrees;
  }
  Words words_;
  std::vector<std::string> letters_;
};

// The conditions that the logarithm of a kernel be `whole`, the sum of the letters of degree 1, transformed
// by the exponential of a Lie series. `divided_out(degree, beyond)` is the span of what vanishes.
template <class Span>
std::vector<OrderCondition> effective(Series product, const Series& sizes, const Series& whole,
                                      const std::vector<std::string>& letters, const Span& divided_out) {
  const Words& words = product.words();
  std::vector<OrderCondition> conditions;
  for (int degree = 1; degree <= words.largest_degree(); ++degree) {
    // exp(Q) K exp(-Q) with Q of the degree before changes the logarithm by [Q, whole] at this degree.
    const std::vector<std::size_t> lyndon = words.lyndon(degree);
    std::vector<Series> processors;
    if (degree > 1)
      for (const std::size_t word : words.lyndon(degree - 1))
        processors.push_back(bracketing<Quad>(words, word));
    ReducedSpan<Quad> span = divided_out(degree, processors.size());
    for (std::size_t k = 0; k < processors.size(); ++k) {
      std::vector<Quad> vector = coordinates(commutator(processors[k], whole), lyndon);
      vector.resize(lyndon.size() + processors.size());
      vector[lyndon.size() + k] = Quad(1);
      span.add(std::move(vector), rounding_of_integers);
    }
    std::vector<Quad> factors;
    append_conditions(conditions, logarithm(product), sizes, span, processors.size(), degree, letters,
                      "whatever the processor, the Lie word ", &factors);
    Series processor(words);
    for (std::size_t k = 0; k < processors.size(); ++k) {
      processors[k] *= factors[k];
      processor += processors[k];
    }
    Series back = processor;
    back *= Quad(-1);
    product = exponential(processor) * product * exponential(back);
  }
  return conditions;
}

}  // namespace

std::vector<OrderCondition> composition_conditions(const std::vector<Quad>& weights, int order) {
  const Compositions compositions(order);
  const Words& words = compositions.words();
  const Series sizes = compositions.of(weights, true), log = logarithm(compositions.of(weights));
  std::vector<OrderCondition> conditions;
  for (int degree = 1; degree <= order; ++degree)
    append_conditions(conditions, log, sizes, ReducedSpan<Quad>(words.lyndon(degree).size()), 0, degree,
                      compositions.letters(), "the Lie word ");
  return conditions;
}

std::vector<OrderCondition> effective_composition_conditions(const std::vector<Quad>& kernel, int order) {
  const Compositions compositions(order);
  const Words& words = compositions.words();
  Series whole(words);
  whole[words.extended(0, 0)] = Quad(1);
  return effective(
      compositions.of(kernel), compositions.of(kernel, true), whole, compositions.letters(),
      [&](int degree, std::size_t /*beyond*/) { return ReducedSpan<Quad>(words.lyndon(degree).size()); });
}

std::vector<OrderCondition> effective_conditions(const std::vector<PartialFlow>& kernel, int order,
                                                 Parts parts) {
  const Words words({1, 1}, order);
  const Ideal ideal(words, parts);
  Series whole = ideal.letter(drift);
  whole += ideal.letter(kick);
  return effective(product_of(words, kernel), product_of(words, kernel, true), whole, parts_named(),
                   [&](int degree, std::size_t beyond) { return ideal.span(degree, beyond); });
}

std::vector<Quad> processed_weights(const std::vector<Quad>& pre, const std::vector<Quad>& kernel) {
  std::vector<Quad> weights = pre;
  weights.insert(weights.end(), kernel.begin(), kernel.end());
  for (std::size_t k = pre.size(); k-- > 0;) weights.push_back(-pre[k]);
  return weights;
}

std::vector<PartialFlow> inverse(std::vector<PartialFlow> flows) {
  std::reverse(flows.begin(), flows.end());
  for (PartialFlow& flow : flows) flow.length = -flow.length;
  return flows;
}

std::vector<PartialFlow> processed_step(const std::vector<PartialFlow>& pre,
                                        const std::vector<PartialFlow>& kernel) {
  std::vector<PartialFlow> step = pre;
  const std::vector<PartialFlow> post = inverse(pre);
  step.insert(step.end(), kernel.begin(), kernel.end());
  step.insert(step.end(), post.begin(), post.end());
  return step;
}

}  // namespace pfaff
