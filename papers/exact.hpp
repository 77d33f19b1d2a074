// Exact samples for formulas about matrices of brackets: fractions, always the same ones. The engine's Dirac
// brackets of such matrices.
#pragma once

#include <cstddef>
#include <random>

#include <pfaff/brackets/conformance/residuals.hpp>
#include <pfaff/brackets/dirac/dirac.hpp>
#include <pfaff/brackets/tensor.hpp>
#include <pfaff/core/linear/matrix.hpp>
#include <pfaff/core/numbers/rational.hpp>
#include <pfaff/papers/printed/dense.hpp>
#include <pfaff/papers/rows.hpp>

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
inline Numbers quads(const printed::Table<Rational>& m) { return quads(printed::listed(m)); }
/// So many zeros.
inline Numbers zeros(std::size_t count) { return Numbers(count); }

/// The same numbers for printed formulas.
template <class T>
printed::Table<T> table_of(const Matrix<T>& m) {
  printed::Table<T> table = printed::zero_table<T>(m.rows(), m.columns());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) table[i][j] = m(i, j);
  return table;
}

inline ExactMatrix matrix_of(const printed::Table<Rational>& table) {
  ExactMatrix m(table.size(), table.front().size());
  for (std::size_t i = 0; i < m.rows(); ++i)
    for (std::size_t j = 0; j < m.columns(); ++j) m(i, j) = table[i][j];
  return m;
}

/// The first coordinates as constraints.
struct FirstCoordinates {
  std::size_t number = 0;
  [[nodiscard]] std::size_t count() const { return number; }
  template <class T>
  void values(const T& /*t*/, In<T> z, Out<T> phi) const {
    for (std::size_t i = 0; i < number; ++i) phi[i] = z[i];
  }
  template <class T>
  void gradients(const T& /*t*/, In<T> z, Out<T> rows) const {
    for (std::size_t i = 0; i < number; ++i)
      for (std::size_t k = 0; k < z.size(); ++k) rows[i * z.size() + k] = T(i == k ? 1 : 0);
  }
};

/// The engine's Dirac bracket of the elements after the first `count`, which are the constraints, from all
/// their brackets G: G is the tensor of a bracket of the coordinates, and the first coordinates are the
/// constraints.
template <class Solver = DenseDirac>
ExactMatrix engine_brackets(const ExactMatrix& g, std::size_t count, Symmetry symmetry, Solver solver = {}) {
  const auto base = tensor_bracket([g](const auto&, auto, auto entries) {
    for (std::size_t k = 0; k < entries.size(); ++k) entries[k] = g.entries()[k];
  });
  const auto bracket = dirac(base, FirstCoordinates{count}, solver, symmetry);
  const ExactMatrix all = bracket_matrix<Rational>(bracket, Rational(0), std::vector<Rational>(g.rows()));
  return all.block(count, count, g.rows() - count, g.rows() - count);
}

/// Columns that span the kernel of A, whose leading square block is regular.
ExactMatrix kernel_columns(const ExactMatrix& a);

}  // namespace pfaff
