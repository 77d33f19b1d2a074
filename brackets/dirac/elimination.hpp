// Elimination of constraints from a Gram matrix, step by step, as the recursion of Dirac brackets does it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <pfaff/brackets/dirac/classification.hpp>

namespace pfaff {

/// What is left of a Gram matrix G after each step of an elimination. For every entry it keeps the size of
/// the terms that the entry was computed from, by which its round-off is judged.
template <class T>
class Elimination {
 public:
  /// Only the constraints with an index in `active` take part.
  Elimination(const Matrix<T>& w, Symmetry symmetry, const Matrix<T>& sizes, std::vector<std::size_t> active)
      : symmetry_(symmetry), g_(w), sizes_(w.rows(), w.columns()), rows_(std::move(active)), columns_(rows_) {
    const std::size_t n = w.rows();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const T size = abs(w(i, j));
        sizes_(i, j) = sizes.rows() > 0 && sizes(i, j) > size ? sizes(i, j) : size;
      }
    zero_ = T(16) * T(static_cast<int>(std::max<std::size_t>(n, 1))) * unit_roundoff<T>();
    balance();
  }

  /// Compares in the units that were found for another matrix.
  void set_scale(const std::vector<double>& scale) { scale_ = scale; }
  [[nodiscard]] const std::vector<double>& scale() const { return scale_; }
  [[nodiscard]] const std::vector<std::size_t>& rows() const { return rows_; }
  [[nodiscard]] const std::vector<std::size_t>& columns() const { return columns_; }
  [[nodiscard]] const T& operator()(std::size_t i, std::size_t j) const { return g_(i, j); }

  /// The magnitude of G_ij for comparisons, in which the units of the constraints cancel; 0 where G_ij is no
  /// more than the round-off of its terms.
  [[nodiscard]] double magnitude(std::size_t i, std::size_t j) const {
    const T size = abs(g_(i, j));
    if (!(size > zero_ * sizes_(i, j))) return 0;
    return std::max(static_cast<double>(size) * scale_[i] * scale_[j], smallest);
  }
  /// The magnitude of the pivot of a step. For a pair of a symmetric bracket it is the root of the
  /// determinant, so that steps of one constraint and of two can be compared.
  [[nodiscard]] double magnitude(const Pivot<T>& pivot) const {
    const std::size_t a = pivot.rows[0];
    if (pivot.rows.size() == 1) return magnitude(a, pivot.columns[0]);
    const std::size_t b = pivot.rows[1];
    if (symmetry_ == Symmetry::skew) return magnitude(a, b);
    const T straight = g_(a, a) * g_(b, b), crossed = g_(a, b) * g_(b, a);
    const T size = sizes_(a, a) * sizes_(b, b) + sizes_(a, b) * sizes_(b, a), value = abs(straight - crossed);
    if (!(value > zero_ * size)) return 0;
    return std::max(std::sqrt(static_cast<double>(value)) * scale_[a] * scale_[b], smallest);
  }

  /// The best pivot that is left; without rows where nothing is left but round-off.
  [[nodiscard]] Pivot<T> best() const {
    Pivot<T> single, pair;
    double largest_single = 0, largest_pair = 0;
    for (const std::size_t i : rows_)
      for (const std::size_t j : columns_) {
        const double size = magnitude(i, j);
        if (symmetry_ == Symmetry::none || (i == j && symmetry_ == Symmetry::symmetric)) {
          if (size > largest_single) {
            largest_single = size;
            single = {{i}, {j}, {}};
          }
        } else if (i < j && size > largest_pair) {
          largest_pair = size;
          pair = {{i, j}, {i, j}, {}};
        }
      }
    // Bunch & Parlett's constant, with which two steps of one constraint and one step of a pair have the same
    // bound of growth.
    constexpr double single_preferred = 0.6403882032022076;
    Pivot<T> chosen = largest_single > 0 && largest_single >= single_preferred * largest_pair ? single : pair;
    if (!chosen.rows.empty()) chosen.value = value(chosen);
    return chosen;
  }

  /// What a step divides by.
  [[nodiscard]] T value(const Pivot<T>& pivot) const {
    const std::size_t a = pivot.rows[0];
    if (pivot.rows.size() == 1) return g_(a, pivot.columns[0]);
    const std::size_t b = pivot.rows[1];
    if (symmetry_ == Symmetry::skew) return g_(a, b);
    return g_(a, a) * g_(b, b) - g_(a, b) * g_(b, a);
  }

  /// G <- G - G[:, columns] (G[rows, columns])^-1 G[rows, :]. The rows and columns of the step, zero by this
  /// formula, become exactly zero.
  void eliminate(const Pivot<T>& pivot) {
    const Matrix<T> g = g_, sizes = sizes_;
    const T value = this->value(pivot);
    for (const std::size_t i : rows_)
      for (const std::size_t j : columns_) reduce(g, sizes, pivot, value, i, j);
    for (const std::size_t r : pivot.rows) {
      std::erase(rows_, r);
      for (std::size_t j = 0; j < g_.columns(); ++j) g_(r, j) = T(0);
    }
    for (const std::size_t c : pivot.columns) {
      std::erase(columns_, c);
      for (std::size_t i = 0; i < g_.rows(); ++i) g_(i, c) = T(0);
    }
  }

 private:
  static constexpr double smallest = 1e-300;  // for an exact number that is smaller than any double

  void reduce(const Matrix<T>& g, const Matrix<T>& sizes, const Pivot<T>& pivot, const T& value,
              std::size_t i, std::size_t j) {
    const std::size_t a = pivot.rows[0], c = pivot.columns[0];
    T& size = sizes_(i, j);
    const auto grow = [&size](const T& x) {
      if (x > size) size = x;
    };
    const auto grow_by = [&](std::size_t column, std::size_t row, const T& pivot_size) {
      grow(abs(g(i, column)) * sizes(row, j) / pivot_size);
      grow(sizes(i, column) * abs(g(row, j)) / pivot_size);
    };
    if (pivot.rows.size() == 1) {
      g_(i, j) = g(i, j) - g(i, c) * g(a, j) / value;
      grow_by(c, a, abs(value));
      return;
    }
    const std::size_t b = pivot.rows[1];
    if (symmetry_ == Symmetry::skew) {  // (3.15)
      g_(i, j) = g(i, j) - (g(i, b) * g(a, j) - g(i, a) * g(b, j)) / value;
      grow_by(b, a, abs(value));
      grow_by(a, b, abs(value));
      return;
    }
    const T left = (g(b, b) * g(a, j) - g(a, b) * g(b, j)) / value;
    const T right = (g(a, a) * g(b, j) - g(b, a) * g(a, j)) / value;
    g_(i, j) = g(i, j) - g(i, a) * left - g(i, b) * right;
    grow(abs(left) * sizes(i, a) + abs(right) * sizes(i, b));
    const T of_left = (abs(g(i, a)) * abs(g(b, b)) + abs(g(i, b)) * abs(g(b, a))) / abs(value);
    const T of_right = (abs(g(i, b)) * abs(g(a, a)) + abs(g(i, a)) * abs(g(a, b))) / abs(value);
    grow(of_left * sizes(a, j) + of_right * sizes(b, j));
  }

  // Finds scales s with s_i |terms of G_ij| s_j about 1: those with the least sum of squares of the
  // logarithms of these products (Curtis & Reid), by coordinate descent. Other units of the constraints
  // change the scales and leave the products as they are.
  void balance() {
    const std::size_t n = g_.rows();
    scale_.assign(n, 1);
    if constexpr (std::numeric_limits<T>::is_exact) return;
    std::vector<double> exponent(n, 0);
    for (int sweep = 0; sweep < 50; ++sweep)
      for (const std::size_t i : rows_) {
        double sum = 0;
        int count = 0;
        for (const std::size_t j : rows_)
          for (const T& size : {sizes_(i, j), sizes_(j, i)}) {
            if (!(size > T(0)) || i == j) continue;
            sum -= std::log2(std::max(static_cast<double>(size), smallest)) + exponent[j];
            ++count;
          }
        if (sizes_(i, i) > T(0)) {
          sum -= 2 * std::log2(std::max(static_cast<double>(sizes_(i, i)), smallest));
          count += 4;  // it contains the scale twice
        }
        if (count > 0) exponent[i] = sum / count;
      }
    for (std::size_t i = 0; i < n; ++i) scale_[i] = std::exp2(exponent[i]);
  }

  Symmetry symmetry_;
  Matrix<T> g_, sizes_;
  std::vector<std::size_t> rows_, columns_;
  std::vector<double> scale_;
  T zero_;
};

}  // namespace pfaff
