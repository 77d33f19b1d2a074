// Words and their series: the free associative algebra, up to a degree.
//
// A composition of flows, such as exp(a1 A) exp(b1 B) exp(a2 A) ... with operators A and B that do not
// commute and have no relations, is a sum of words in the letters A, B with numbers as coefficients. Its
// logarithm is a Lie series, and a Lie series is determined by the coefficients of its Lyndon words, those
// that are smaller than each of their proper endings; there are as many of a degree as the free Lie algebra
// has dimensions there (Witt's formula; for two letters of degree 1: 2, 1, 2, 3, 6, 9, 18, 30, 56, 99, ...).
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pfaff {

/// All words up to a degree over letters with degrees of their own. Words are numbered; 0 is the empty one,
/// and those of smaller degree come first.
class Words {
 public:
  /// `degrees[l]` > 0 is the degree of letter l.
  Words(std::vector<int> degrees, int degree);

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] std::size_t letters() const { return degrees_.size(); }
  [[nodiscard]] int degree_of_letter(std::size_t letter) const { return degrees_[letter]; }
  [[nodiscard]] int largest_degree() const { return degree_; }
  [[nodiscard]] int degree(std::size_t word) const { return entries_[word].degree; }
  /// A word without its last letter, and that letter.
  [[nodiscard]] std::size_t beginning(std::size_t word) const { return entries_[word].beginning; }
  [[nodiscard]] std::size_t last(std::size_t word) const { return entries_[word].last; }
  /// A word with one more letter; `none` where its degree is too large.
  [[nodiscard]] std::size_t extended(std::size_t word, std::size_t letter) const {
    return extended_[word * degrees_.size() + letter];
  }
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  /// The letters of a word.
  [[nodiscard]] std::vector<std::size_t> spelt(std::size_t word) const;
  /// The word of these letters; `none` where its degree is too large.
  [[nodiscard]] std::size_t find(const std::vector<std::size_t>& letters) const;
  /// The Lyndon words of a degree, with the letters in the order of their numbers.
  [[nodiscard]] std::vector<std::size_t> lyndon(int degree) const;
  /// The factors of a Lyndon word of two letters or more: its longest proper ending that is a Lyndon word,
  /// and what stands before it, which is one too.
  [[nodiscard]] std::pair<std::size_t, std::size_t> factors(std::size_t lyndon_word) const;

 private:
  struct Entry {
    std::size_t beginning = 0, last = 0;
    int degree = 0;
  };
  std::vector<int> degrees_;
  int degree_;
  std::vector<Entry> entries_;
  std::vector<std::size_t> extended_;
};

/// A sum of words with coefficients of T, cut off beyond the largest degree of `words`, which must outlive
/// it.
template <class T>
class WordSeries {
 public:
  explicit WordSeries(const Words& words) : words_(&words), coefficients_(words.size(), T(0)) {}
  /// The empty word, the identity.
  static WordSeries one(const Words& words) {
    WordSeries unit(words);
    unit[0] = T(1);
    return unit;
  }

  [[nodiscard]] const Words& words() const { return *words_; }
  T& operator[](std::size_t word) { return coefficients_[word]; }
  const T& operator[](std::size_t word) const { return coefficients_[word]; }

  WordSeries& operator+=(const WordSeries& other) {
    for (std::size_t w = 0; w < coefficients_.size(); ++w)
      coefficients_[w] = coefficients_[w] + other.coefficients_[w];
    return *this;
  }
  WordSeries& operator-=(const WordSeries& other) {
    for (std::size_t w = 0; w < coefficients_.size(); ++w)
      coefficients_[w] = coefficients_[w] - other.coefficients_[w];
    return *this;
  }
  WordSeries& operator*=(const T& factor) {
    for (T& x : coefficients_) x = x * factor;
    return *this;
  }
  friend WordSeries operator*(const WordSeries& a, const WordSeries& b) {
    return a.times(b, a.words_->largest_degree());
  }
  /// This times another one, without the words beyond a degree.
  [[nodiscard]] WordSeries times(const WordSeries& b, int degree) const {
    const WordSeries& a = *this;
    const Words& words = *words_;
    WordSeries product(words);
    std::vector<std::size_t> joined(words.size());
    for (std::size_t v = 0; v < words.size() && words.degree(v) <= degree; ++v) {
      if (a[v] == T(0)) continue;
      joined[0] = v;
      product[v] = product[v] + a[v] * b[0];
      for (std::size_t w = 1; w < words.size(); ++w) {
        if (words.degree(v) + words.degree(w) > degree) break;
        joined[w] = words.extended(joined[words.beginning(w)], words.last(w));
        product[joined[w]] = product[joined[w]] + a[v] * b[w];
      }
    }
    return product;
  }
  /// This times exp(length letter).
  void times_exponential(std::size_t letter, const T& length) {
    // From the longest words to the shortest, so that those on the right are still the old ones.
    for (std::size_t w = coefficients_.size(); w-- > 1;) {
      T term(1);
      int count = 0;
      for (std::size_t end = w; end != 0 && words_->last(end) == letter;) {
        end = words_->beginning(end);
        term = term * length / T(++count);
        coefficients_[w] = coefficients_[w] + term * coefficients_[end];
      }
    }
  }
  /// This times exp(sum_l lengths[l] letter_l).
  void times_exponential_of_sum(const std::vector<T>& lengths) {
    std::vector<T> term = coefficients_;  // this times the k-th term of the exponential
    for (int k = 1; k <= words_->largest_degree(); ++k) {
      for (std::size_t w = term.size(); w-- > 1;)
        term[w] = term[words_->beginning(w)] * lengths[words_->last(w)] / T(k);
      term[0] = T(0);
      for (std::size_t w = 0; w < term.size(); ++w) coefficients_[w] = coefficients_[w] + term[w];
    }
  }

 private:
  const Words* words_;
  std::vector<T> coefficients_;
};

/// [a, b] = a b - b a.
template <class T>
WordSeries<T> commutator(const WordSeries<T>& a, const WordSeries<T>& b) {
  WordSeries<T> bracket = a * b;
  bracket -= b * a;
  return bracket;
}

// What stands within k factors x is needed without the k highest degrees, because x has no empty word.

/// exp(x) of a series without the empty word.
template <class T>
WordSeries<T> exponential(const WordSeries<T>& x) {
  const int degree = x.words().largest_degree();
  WordSeries<T> sum = WordSeries<T>::one(x.words());
  for (int k = degree; k > 0; --k) {  // 1 + x/1 (1 + x/2 (1 + x/3 ...))
    sum = x.times(sum, degree - k + 1);
    sum *= T(1) / T(k);
    sum[0] = sum[0] + T(1);
  }
  return sum;
}

/// log(x) of a series in which the empty word has the coefficient 1.
template <class T>
WordSeries<T> logarithm(WordSeries<T> x) {
  x[0] = x[0] - T(1);
  const int degree = x.words().largest_degree();
  WordSeries<T> sum(x.words());
  for (int k = degree; k > 0; --k) {  // x (1 - x (1/2 - x (1/3 - ...)))
    WordSeries<T> inner(x.words());
    inner[0] = T(1) / T(k);
    inner -= sum;
    sum = x.times(inner, degree - k + 1);
  }
  return sum;
}

/// The bracketing of a Lyndon word: a letter, or [u, v] for the word u v with v its longest proper ending
/// that is a Lyndon word. Those of one degree are a basis of the free Lie algebra there.
template <class T>
WordSeries<T> bracketing(const Words& words, std::size_t lyndon_word);

}  // namespace pfaff
