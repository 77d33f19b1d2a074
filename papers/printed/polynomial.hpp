// Polynomials in any number of variables with exact coefficients: functions whose derivatives, brackets and
// integrals along rays are known in closed form, for formulas as papers print them.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include <pfaff/core/numbers/rational.hpp>

namespace pfaff::printed {

/// A sum of monomials, powers of the variables (trailing zeros left out) with their coefficients.
class Polynomial {
 public:
  using Powers = std::vector<int>;

  Polynomial() = default;
  Polynomial(const Rational& constant) { add({}, constant); }  // NOLINT(google-explicit-constructor)
  /// The variable with this index.
  static Polynomial variable(std::size_t index) {
    Powers powers(index + 1, 0);
    powers[index] = 1;
    Polynomial p;
    p.add(std::move(powers), Rational(1));
    return p;
  }

  [[nodiscard]] const std::map<Powers, Rational>& terms() const { return terms_; }

  friend Polynomial operator+(Polynomial a, const Polynomial& b) {
    for (const auto& [powers, coefficient] : b.terms_) a.add(powers, coefficient);
    return a;
  }
  friend Polynomial operator-(Polynomial a, const Polynomial& b) {
    for (const auto& [powers, coefficient] : b.terms_) a.add(powers, Rational(0) - coefficient);
    return a;
  }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial p;
    for (const auto& [left, first] : a.terms_)
      for (const auto& [right, second] : b.terms_) {
        Powers powers = left;
        if (powers.size() < right.size()) powers.resize(right.size(), 0);
        for (std::size_t k = 0; k < right.size(); ++k) powers[k] += right[k];
        p.add(std::move(powers), first * second);
      }
    return p;
  }

  /// The derivative by one variable.
  [[nodiscard]] Polynomial slope(std::size_t index) const {
    Polynomial p;
    for (const auto& [powers, coefficient] : terms_) {
      if (powers.size() <= index || powers[index] == 0) continue;
      Powers lower = powers;
      --lower[index];
      p.add(std::move(lower), Rational(powers[index]) * coefficient);
    }
    return p;
  }
  /// int_0^1 lambda^k p(lambda z_1, .., lambda z_n, rest) dlambda for the first `count` variables.
  [[nodiscard]] Polynomial along_ray(std::size_t count, int k) const {
    Polynomial p;
    for (const auto& [powers, coefficient] : terms_) {
      int degree = k;
      for (std::size_t j = 0; j < count && j < powers.size(); ++j) degree += powers[j];
      p.add(powers, coefficient / Rational(degree + 1));
    }
    return p;
  }
  /// The value at a point, for any scalar that a Rational converts to.
  template <class T>
  [[nodiscard]] T at(const std::vector<T>& z) const {
    T sum(0);
    for (const auto& [powers, coefficient] : terms_) {
      T term = static_cast<T>(coefficient);
      for (std::size_t k = 0; k < powers.size(); ++k)
        for (int power = 0; power < powers[k]; ++power) term = term * z[k];
      sum = sum + term;
    }
    return sum;
  }

 private:
  void add(Powers powers, const Rational& coefficient) {
    while (!powers.empty() && powers.back() == 0) powers.pop_back();
    Rational& total = terms_[powers];
    total = total + coefficient;
    if (total == Rational(0)) terms_.erase(powers);
  }
  std::map<Powers, Rational> terms_;
};

}  // namespace pfaff::printed
