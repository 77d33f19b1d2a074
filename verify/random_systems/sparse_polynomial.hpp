// Polynomials in the state and the time with exact coefficients, the formulas of random systems. They can be
// added, multiplied, differentiated and put into each other, so that a formula that follows from others is
// again a polynomial, which can be evaluated with every scalar and printed.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <pfaff/core/numbers/functions.hpp>

namespace pfaff {

/// The powers of the variables in one term; that of the time stands last.
using Powers = std::vector<int>;

/// sum of c z_1^a_1 ... z_n^a_n t^b over its terms.
class SparsePolynomial {
 public:
  /// The polynomial 0 in so many variables, the time not counted.
  explicit SparsePolynomial(std::size_t variables) : variables_(variables) {}
  /// The constant `value`.
  static SparsePolynomial constant(std::size_t variables, const Real& value);
  /// The variable of this index; index `variables` is the time.
  static SparsePolynomial variable(std::size_t variables, std::size_t index);

  [[nodiscard]] std::size_t variables() const { return variables_; }
  /// The terms by their powers; no coefficient is zero.
  [[nodiscard]] const std::map<Powers, Real>& terms() const { return terms_; }
  [[nodiscard]] bool zero() const { return terms_.empty(); }
  /// The sum of the powers of a term's variables and of the time, the largest of all terms.
  [[nodiscard]] int degree() const;
  /// True where every term has this degree in the state and none depends on the time.
  [[nodiscard]] bool homogeneous(int degree) const;
  /// True where the variable of this index, or the time, occurs.
  [[nodiscard]] bool depends_on(std::size_t index) const;

  /// Adds c times the product of powers.
  void add(const Powers& powers, const Real& c);

  friend SparsePolynomial operator+(SparsePolynomial a, const SparsePolynomial& b);
  friend SparsePolynomial operator-(SparsePolynomial a, const SparsePolynomial& b);
  friend SparsePolynomial operator*(const SparsePolynomial& a, const SparsePolynomial& b);
  friend SparsePolynomial operator*(const Real& c, const SparsePolynomial& a);
  friend bool operator==(const SparsePolynomial& a, const SparsePolynomial& b) = default;

  /// The derivative in the variable of this index, or in the time.
  [[nodiscard]] SparsePolynomial derivative(std::size_t index) const;
  /// The polynomial of `values` in place of the variables; they all have the same variables. The time stays.
  [[nodiscard]] SparsePolynomial at(const std::vector<SparsePolynomial>& values) const;
  /// The value at a state and a time, exact as far as fractions of 64-bit integers go.
  [[nodiscard]] Real exactly(const Real& t, const std::vector<Real>& z) const;

  /// The value at time t and the variables z.
  template <class T>
  T operator()(const T& t, In<T> z) const {
    T sum(0);
    for (const auto& [powers, c] : terms_) {
      T product(c);
      for (std::size_t k = 0; k < powers.size(); ++k)
        for (int power = 0; power < powers[k]; ++power) product = product * (k < variables_ ? z[k] : t);
      sum = sum + product;
    }
    return sum;
  }

  /// The polynomial as an expression of a text model, with the variables called as `name` says.
  /// `name(variables())` is the time.
  [[nodiscard]] std::string text(const std::function<std::string(std::size_t index)>& name) const;

 private:
  std::size_t variables_;
  std::map<Powers, Real> terms_;
};

/// Several in the same variables or not, such as the components of a field.
using Polynomials = std::vector<SparsePolynomial>;

}  // namespace pfaff
