// Coordinates of Lie series, degree by degree, with a part of the Lie algebra divided out.
//
// A Lie polynomial of one degree is a vector of the coefficients of its Lyndon words. Divided out are some
// vectors of that degree, elements of an ideal for instance: they are brought to reduced echelon form, and
// what is left of a vector is its coordinates off the pivots, which are zero exactly where the vector lies in
// the span.
#pragma once

#include <vector>

#include <pfaff/integrators/order_conditions/word_series.hpp>

namespace pfaff {

/// A span of vectors to which vectors can be added and from which others are reduced. Vectors may be longer
/// than the dimension: pivots are not sought in what is beyond it, which follows the operations along and so
/// can tell of what a vector was combined.
template <class T>
class ReducedSpan {
 public:
  explicit ReducedSpan(std::size_t dimension) : dimension_(dimension) {}

  /// Adds a vector. False where it lies in the span: where nothing of it is left, to `negligible`.
  bool add(std::vector<T> vector, const T& negligible) {
    reduce(vector);
    std::size_t pivot = 0;
    for (std::size_t k = 1; k < dimension_; ++k)
      if (abs(vector[k]) > abs(vector[pivot])) pivot = k;
    if (!(abs(vector[pivot]) > negligible)) return false;
    const T scale = T(1) / vector[pivot];
    for (T& x : vector) x = x * scale;
    vector[pivot] = T(1);
    for (Row& row : rows_) eliminate(row.vector, vector, pivot);
    rows_.push_back({pivot, std::move(vector)});
    return true;
  }
  /// Takes off a vector what lies in the span; its coordinates at the pivots become zero.
  void reduce(std::vector<T>& vector) const {
    for (const Row& row : rows_) eliminate(vector, row.vector, row.pivot);
  }
  [[nodiscard]] bool is_pivot(std::size_t coordinate) const {
    for (const Row& row : rows_)
      if (row.pivot == coordinate) return true;
    return false;
  }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }

 private:
  struct Row {
    std::size_t pivot;
    std::vector<T> vector;
  };
  static void eliminate(std::vector<T>& vector, const std::vector<T>& row, std::size_t pivot) {
    const T factor = vector[pivot];
    if (factor == T(0)) return;
    for (std::size_t k = 0; k < row.size(); ++k) vector[k] = vector[k] - factor * row[k];
    vector[pivot] = T(0);
  }

  std::size_t dimension_;
  std::vector<Row> rows_;
};

/// The coefficients of these words.
template <class T>
std::vector<T> coordinates(const WordSeries<T>& series, const std::vector<std::size_t>& words) {
  std::vector<T> vector;
  for (const std::size_t word : words) vector.push_back(series[word]);
  return vector;
}

}  // namespace pfaff
