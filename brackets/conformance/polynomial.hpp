// Random polynomials, to test brackets with: functions of any state, with gradients, in every scalar.
#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include <pfaff/core/numbers/dual.hpp>

namespace pfaff {

/// A polynomial of degree 3 in n variables with coefficients that are fractions with denominator 4; exact in
/// every scalar.
class Polynomial {
 public:
  /// Coefficients in [-2, 2] drawn from `random`; `terms` monomials and every variable.
  template <class Random>
  Polynomial(std::size_t n, Random& random, int terms = 6) {
    std::uniform_int_distribution<int> coefficient(-8, 8), degree(2, 3);
    std::uniform_int_distribution<std::size_t> variable(0, n - 1);
    for (std::size_t k = 0; k < n; ++k) monomials_.push_back({coefficient(random), {k}});
    for (int k = 0; k < terms; ++k) {
      Monomial m{coefficient(random), {}};
      for (int power = degree(random); power > 0; --power) m.variables.push_back(variable(random));
      monomials_.push_back(m);
    }
  }

  template <class T>
  T operator()(In<T> z) const {
    T sum(0);
    for (const Monomial& m : monomials_) {
      T product = T(m.coefficient) / T(4);
      for (const std::size_t k : m.variables) product = product * z[k];
      sum = sum + product;
    }
    return sum;
  }
  template <class T>
  std::vector<T> gradient(In<T> z) const {
    std::vector<T> slope(z.size());
    for (const Monomial& m : monomials_)
      for (std::size_t out = 0; out < m.variables.size(); ++out) {
        T product = T(m.coefficient) / T(4);
        for (std::size_t k = 0; k < m.variables.size(); ++k)
          if (k != out) product = product * z[m.variables[k]];
        slope[m.variables[out]] = slope[m.variables[out]] + product;
      }
    return slope;
  }

 private:
  struct Monomial {
    int coefficient;
    std::vector<std::size_t> variables;
  };
  std::vector<Monomial> monomials_;
};

}  // namespace pfaff
