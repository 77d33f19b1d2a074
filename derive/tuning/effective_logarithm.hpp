// What a processor can remove of the logarithm of a kernel, and what not.
//
// The logarithm of a palindrome K is X + E3 + E5 + ... with X = A + B, h = 1, and E_d of degree d. That of
// exp(Q) K exp(-Q) is exp(ad Q) applied to it. Q2 of degree 2 adds [Q2, X] at degree 3; Q4 adds [Q4, X] at
// degree 5 and so on, so that all of E_d but its part outside of [L, X], with L the Lie polynomials of degree
// d - 1, can be removed (blanes-casas-ros1999; blanes-casas2016). Where this part is zero for d = 3, 5, ...,
// p - 1, K is of effective order p. Once these degrees are removed, degree d = p + 1 or p + 3 changes by
// exactly [Q, X] with Q of degree d - 1, all other brackets being of higher degree.
#pragma once

#include <vector>

#include <pfaff/core/numbers/functions.hpp>
#include <pfaff/derive/tuning/shadow_terms.hpp>
#include <pfaff/derive/tuning/splitting_logarithm.hpp>
#include <pfaff/integrators/order_conditions/lie_quotient.hpp>

namespace pfaff {

/// exp(ad q) x = x + [q, x] + [q, [q, x]]/2 + ... for q without letters, degree 2 and more.
template <class T>
WordSeries<T> transformed(const WordSeries<T>& q, const WordSeries<T>& x) {
  WordSeries<T> sum = x, term = x;
  for (int k = 1; 2 * k < x.words().largest_degree(); ++k) {
    term = commutator(q, term);
    term *= T(1) / T(k);
    sum += term;
  }
  return sum;
}

/// X = A + B.
template <class T>
WordSeries<T> sum_of_letters(const Words& words) {
  WordSeries<T> sum(words);
  for (const std::size_t letter : {0U, 1U}) sum[words.extended(0, letter)] = T(1);
  return sum;
}

/// Kernels of an even order, by series of words of the type T.
template <class T>
class KernelSeries {
 public:
  /// Series of these words, which must outlive it.
  KernelSeries(const Words& words, int order) : words_(words) {
    const WordSeries<T> whole = sum_of_letters<T>(words);
    for (int degree = 3; degree < order; degree += 2) {
      Removal removal{words.lyndon(degree), {}, ReducedSpan<T>(words.lyndon(degree).size())};
      for (const std::size_t word : words.lyndon(degree - 1))
        removal.by.push_back(bracketing<T>(words, word));
      for (std::size_t k = 0; k < removal.by.size(); ++k) {
        std::vector<T> vector = coordinates(commutator(removal.by[k], whole), removal.lyndon);
        vector.resize(removal.lyndon.size() + removal.by.size(), T(0));
        vector[removal.lyndon.size() + k] = T(1);
        // The vectors are of integers and independent: no Lie polynomial of degree 2 and more commutes with
        // X.
        removal.removed.add(std::move(vector), T(1e-10));
      }
      removals_.push_back(std::move(removal));
    }
  }

  struct Lifted {
    /// What is left of the degrees 1, 3, ..., order - 1: zero for kernels of that effective order.
    std::vector<T> conditions;
    /// exp(Q) for the Q that removes the rest of these degrees, and the logarithm after that.
    WordSeries<T> processor, logarithm;
  };
  [[nodiscard]] Lifted of(const std::vector<PartialFlow>& kernel) const {
    Lifted result{{}, WordSeries<T>::one(words_), pfaff::logarithm(series_of<T>(words_, kernel))};
    for (const std::size_t word : words_.lyndon(1))
      result.conditions.push_back(result.logarithm[word] - T(1));
    for (const Removal& removal : removals_) {
      const std::size_t n = removal.lyndon.size(), count = removal.by.size();
      std::vector<T> vector = coordinates(result.logarithm, removal.lyndon);
      vector.resize(n + count, T(0));
      removal.removed.reduce(vector);
      for (std::size_t k = 0; k < n; ++k)
        if (!removal.removed.is_pivot(k)) result.conditions.push_back(vector[k]);
      WordSeries<T> q(words_);
      for (std::size_t k = 0; k < count; ++k) {
        WordSeries<T> term = removal.by[k];
        term *= vector[n + k];
        q += term;
      }
      result.logarithm = transformed(q, result.logarithm);
      result.processor = exponential(q) * result.processor;
    }
    return result;
  }

 private:
  struct Removal {
    std::vector<std::size_t> lyndon;  // of one degree
    std::vector<WordSeries<T>> by;    // a basis of the degree below
    ReducedSpan<T> removed;           // their brackets with X, followed by the number of each
  };
  const Words& words_;
  std::vector<Removal> removals_;
};

/// The leading shadow terms of kernels less what processors remove of them.
class Irremovable {
 public:
  /// For a logarithm of all degrees and the terms made with it, which must outlive this.
  Irremovable(const SplittingLogarithm& logarithm, const ShadowTerms& terms);

  /// What is left of R c (ShadowTerms::weighted) by the best Q of degrees order, order + 1 and order + 2, for
  /// the logarithm of a kernel whose lower degrees were removed. Its length is the smallest that
  /// ShadowTerms::of gives for any processor.
  [[nodiscard]] std::vector<double> of(const WordSeries<double>& log) const;
  /// All of R c.
  [[nodiscard]] std::vector<double> all(const WordSeries<double>& log) const;

 private:
  const SplittingLogarithm& logarithm_;
  const ShadowTerms& terms_;
  std::vector<std::vector<double>> removable_;  // orthonormal
};

}  // namespace pfaff
