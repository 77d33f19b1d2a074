// Exact samples for formulas about matrices of brackets: fractions, always the same ones.
#pragma once

#include <cstddef>
#include <random>

#include <pfaff/bench/reproduce/rows.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/numbers/rational.hpp>

namespace pfaff {

using ExactMatrix = Matrix<Rational>;

/// Matrices of fractions with numerators up to 12 and denominators up to 4.
class ExactSamples {
 public:
  explicit ExactSamples(unsigned seed) : random_(seed) {}

  Rational number() {
    std::uniform_int_distribution<int> above(-12, 12), below(1, 4);
    const int numerator = above(random_);
    return Rational(numerator) / Rational(below(random_));
  }
  ExactMatrix any(std::size_t rows, std::size_t columns) {
    ExactMatrix m(rows, columns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) m(i, j) = number();
    return m;
  }
  ExactMatrix symmetric(std::size_t n) {
    const ExactMatrix m = any(n, n);
    return m + m.transposed();
  }
  ExactMatrix skew(std::size_t n) {
    const ExactMatrix m = any(n, n);
    return m - m.transposed();
  }
  /// A point with small coordinates.
  std::vector<Rational> point(std::size_t n) {
    std::vector<Rational> z;
    for (std::size_t k = 0; k < n; ++k) z.push_back(number() / Rational(4));
    return z;
  }
  std::mt19937& random() { return random_; }

 private:
  std::mt19937 random_;
};

/// Entries rounded to quad for a row.
inline Numbers quads(const std::vector<Rational>& x) {
  Numbers rounded;
  for (const Rational& v : x) rounded.push_back(static_cast<Quad>(v));
  return rounded;
}
inline Numbers quads(const ExactMatrix& m) { return quads(m.entries()); }
/// So many zeros.
inline Numbers zeros(std::size_t count) { return Numbers(count); }

/// Columns that span the kernel of A, whose leading square block is regular.
ExactMatrix kernel_columns(const ExactMatrix& a);
/// (1.2) and (3.5): P - P A^T (A P A^T)^-1 A P, on covectors, A the gradients of the constraints in rows.
ExactMatrix dirac_tensor(const ExactMatrix& p, const ExactMatrix& a);
/// (3.5) among the elements after the first `count` of a matrix of brackets, which are the constraints.
ExactMatrix dirac_brackets(const ExactMatrix& g, std::size_t count);
/// The determinant of some rows and columns, F[rows, columns] of nguyen-turski (3.1).
Rational minor_of(const ExactMatrix& f, const std::vector<std::size_t>& rows,
                  const std::vector<std::size_t>& columns);
/// 0, 1, ..., n - 1, and then some more.
std::vector<std::size_t> counted(std::size_t n, std::initializer_list<std::size_t> more = {});

}  // namespace pfaff
