// Matrix: a small dense matrix over any scalar, for formulas that are stated in blocks.
//
// Sizes are known at run time and every operation allocates its result, so that a Matrix has no place
// inside a step.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <pfaff/core/linear/lu.hpp>

namespace pfaff {

/// rows x columns numbers, row-major, zero when made.
template <class T>
class Matrix {
 public:
  Matrix(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns), entries_(rows * columns) {}
  /// The row-major entries of a matrix with `rows` rows.
  Matrix(std::size_t rows, std::span<const T> entries)
      : rows_(rows), columns_(0), entries_(entries.begin(), entries.end()) {
    if (rows > 0) columns_ = entries_.size() / rows;
  }

  static Matrix identity(std::size_t n) {
    Matrix m(n, n);
    for (std::size_t i = 0; i < n; ++i) m(i, i) = T(1);
    return m;
  }

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] const std::vector<T>& entries() const { return entries_; }
  T& operator()(std::size_t i, std::size_t j) { return entries_[i * columns_ + j]; }
  const T& operator()(std::size_t i, std::size_t j) const { return entries_[i * columns_ + j]; }

  /// The part that starts at (row, column).
  [[nodiscard]] Matrix block(std::size_t row, std::size_t column, std::size_t rows,
                             std::size_t columns) const {
    Matrix m(rows, columns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) m(i, j) = (*this)(row + i, column + j);
    return m;
  }
  [[nodiscard]] Matrix transposed() const {
    Matrix m(columns_, rows_);
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t j = 0; j < columns_; ++j) m(j, i) = (*this)(i, j);
    return m;
  }

  friend Matrix operator-(Matrix a) {
    for (T& x : a.entries_) x = -x;
    return a;
  }
  friend Matrix operator+(Matrix a, const Matrix& b) {
    for (std::size_t k = 0; k < a.entries_.size(); ++k) a.entries_[k] = a.entries_[k] + b.entries_[k];
    return a;
  }
  friend Matrix operator-(Matrix a, const Matrix& b) {
    for (std::size_t k = 0; k < a.entries_.size(); ++k) a.entries_[k] = a.entries_[k] - b.entries_[k];
    return a;
  }
  friend Matrix operator*(const T& factor, Matrix a) {
    for (T& x : a.entries_) x = factor * x;
    return a;
  }
  friend Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix m(a.rows_, b.columns_);
    for (std::size_t i = 0; i < a.rows_; ++i)
      for (std::size_t k = 0; k < a.columns_; ++k)
        for (std::size_t j = 0; j < b.columns_; ++j) m(i, j) = m(i, j) + a(i, k) * b(k, j);
    return m;
  }
  friend std::vector<T> operator*(const Matrix& a, const std::vector<T>& x) {
    std::vector<T> y(a.rows_);
    for (std::size_t i = 0; i < a.rows_; ++i)
      for (std::size_t j = 0; j < a.columns_; ++j) y[i] = y[i] + a(i, j) * x[j];
    return y;
  }

 private:
  std::size_t rows_, columns_;
  std::vector<T> entries_;
};

/// The inverse of a square matrix; not-a-number in every entry where it is singular to working precision.
template <class T>
Matrix<T> inverse(const Matrix<T>& a) {
  const std::size_t n = a.rows();
  LU<T> lu(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) lu(i, j) = a(i, j);
  const bool regular = lu.factor();
  Matrix<T> result(n, n);
  std::vector<T> unit(n), column(n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) unit[i] = T(i == j ? 1 : 0);
    if (regular) lu.solve(unit.data(), column.data());
    for (std::size_t i = 0; i < n; ++i)
      result(i, j) = regular ? column[i] : T(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

/// The determinant, by elimination with row pivoting: 0, or a few roundings of the entries, where singular.
template <class T>
T determinant(Matrix<T> a) {
  const std::size_t n = a.rows();
  T product(1);
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (abs(value_of(a(i, k))) > abs(value_of(a(pivot, k)))) pivot = i;
    if (abs(value_of(a(pivot, k))) == Value<T>(0)) return T(0);
    if (pivot != k) {
      for (std::size_t j = 0; j < n; ++j) std::swap(a(k, j), a(pivot, j));
      product = -product;
    }
    product = product * a(k, k);
    for (std::size_t i = k + 1; i < n; ++i) {
      const T factor = a(i, k) / a(k, k);
      for (std::size_t j = k + 1; j < n; ++j) a(i, j) = a(i, j) - factor * a(k, j);
    }
  }
  return product;
}

/// The largest |entry|; not-a-number where an entry is.
template <class T>
Value<T> largest(const Matrix<T>& a) {
  Value<T> worst(0);
  for (const T& x : a.entries()) {
    Value<T> size = abs(value_of(x));
    if (isnan(size)) return size;
    if (size > worst) worst = size;
  }
  return worst;
}

}  // namespace pfaff
